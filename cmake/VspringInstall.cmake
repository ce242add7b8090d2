# cmake --install: headers, library, program, and a package that find_package(vspring) finds.
include(CMakePackageConfigHelpers)

install(TARGETS vspring EXPORT vspringTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/vspring DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT vspringTargets NAMESPACE vspring:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vspring)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/vspringConfig.cmake.in
  ${PROJECT_BINARY_DIR}/vspringConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vspring)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vspringConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vspringConfig.cmake ${PROJECT_BINARY_DIR}/vspringConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/vspring)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
