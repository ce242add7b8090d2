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
if(CMAKE_POSITION_INDEPENDENT_CODE)
  # Functions of the library that call each other can be put inline then, too.
  target_compile_options(vspring_options INTERFACE -fno-semantic-interposition)
endif()
if(VSPRING_WARNINGS_AS_ERRORS)
  target_compile_options(vspring_options INTERFACE -Werror)
endif()
if(VSPRING_SANITIZE)
  target_compile_options(vspring_options INTERFACE -fsanitize=${VSPRING_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(vspring_options INTERFACE -fsanitize=${VSPRING_SANITIZE})
  if(VSPRING_SANITIZE MATCHES "address")
    # What a wrong pointer reads or writes the address sanitizer sees; checks of each pointer beforehand double the time.
    target_compile_options(vspring_options INTERFACE -fno-sanitize=null,alignment,object-size,pointer-overflow,vptr)
  endif()
endif()

include(VspringCompile)
