# cmake --install: headers, library, program, and what find_package(vspring) and pkg-config find. Components are packages of
# VspringPackages.cmake.
include(CMakePackageConfigHelpers)

set(vspring_kinds vspring_static)
if(BUILD_SHARED_LIBS)
  list(APPEND vspring_kinds vspring_shared)
endif()
install(TARGETS ${vspring_kinds} EXPORT vspringTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/vspring DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT vspringTargets NAMESPACE vspring:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vspring)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/vspringConfig.cmake.in
  ${PROJECT_BINARY_DIR}/vspringConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vspring)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vspringConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vspringConfig.cmake ${PROJECT_BINARY_DIR}/vspringConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vspring)

# A static library alone leaves what it needs to whoever links it.
if(BUILD_SHARED_LIBS)
  set(requires_private " fmt")
  set(libs_private " -pthread")
else()
  set(requires_public ", fmt")
  set(libs_public " -pthread")
endif()
file(RELATIVE_PATH prefix_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" prefix_from_pc ${prefix_from_pc})
configure_file(${PROJECT_SOURCE_DIR}/cmake/vspring.pc.in ${PROJECT_BINARY_DIR}/vspring.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/vspring.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
unset(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME)
# Each package has a copy of its own.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
