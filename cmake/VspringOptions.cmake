# Compiler options of every target of the project; never exported to users.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

if(PROJECT_IS_TOP_LEVEL)
  # The program lies at the root of its build folder: build/release/vspring.
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
endif()

add_library(vspring_options INTERFACE)
target_compile_features(vspring_options INTERFACE cxx_std_20)
# No contraction of a*b + c to one rounding: the same source gives the same bits from every compiler and on every machine.
target_compile_options(vspring_options INTERFACE
  -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(VSPRING_WARNINGS_AS_ERRORS)
  target_compile_options(vspring_options INTERFACE -Werror)
endif()
if(VSPRING_SANITIZE)
  target_compile_options(vspring_options INTERFACE -fsanitize=${VSPRING_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(vspring_options INTERFACE -fsanitize=${VSPRING_SANITIZE})
endif()

# What nearly every source includes, read once. A source that forgets an include compiles all the same; scripts/check-names finds it.
function(vspring_precompile target)
  if(VSPRING_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <algorithm> <functional> <string> <vector> ${ARGN})
  endif()
endfunction()

# Sources of one folder are compiled together, some at a time, so that what they include is read and instantiated once.
function(vspring_unite target)
  if(NOT VSPRING_UNITE_SOURCES)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  set(group 0)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    string(MD5 folder "${folder}")
    if(NOT group_${folder} OR NOT room_${folder})
      math(EXPR group "${group} + 1")
      set(group_${folder} ${group})
      set(room_${folder} ${VSPRING_UNITE_SOURCES})
    endif()
    math(EXPR room_${folder} "${room_${folder}} - 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group_${folder}})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
