# How sources are compiled in less time.

# What nearly every source includes, read once. scripts/check-names finds missing includes.
function(vspring_precompile target)
  if(VSPRING_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry> <algorithm> <functional> <string> <vector> ${ARGN})
  endif()
endfunction()

# Sources of one folder are compiled together, some at a time, so that what they include is read and instantiated once.
# vspring_unite(TARGET ACROSS_FOLDERS): those of all folders, where no two have names of their own in common.
function(vspring_unite target)
  if(NOT VSPRING_UNITE_SOURCES)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  set(group 0)
  foreach(source IN LISTS sources)
    if(ARGN STREQUAL "ACROSS_FOLDERS")
      set(folder all)
    else()
      get_filename_component(folder ${source} DIRECTORY)
      string(MD5 folder "${folder}")
    endif()
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
