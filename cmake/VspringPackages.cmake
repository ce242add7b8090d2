# cpack makes Debian packages of what has been built: the program, the library, what builds against it, and the Python module.
set(library_package libvspring${vspring_soversion})
set(debian_version ${PROJECT_VERSION}-1)

# debian_package(COMPONENT PACKAGE SECTION SUMMARY WHAT-IT-IS VARIABLE VALUE...): values as CPACK_DEBIAN_COMPONENT_PACKAGE_VARIABLE
# takes them.
macro(debian_package component package section summary what)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}
vspring moves the nodes of a polygon mesh or a polygonal curve until
curvature changes as gently as the constraints allow.
${what}")
  set(values ${ARGN})
  while(values)
    list(POP_FRONT values variable value)
    set(CPACK_DEBIAN_${upper}_PACKAGE_${variable} ${value})
  endwhile()
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${documents} RENAME copyright COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian.gz ${PROJECT_BINARY_DIR}/changelog.gz
    DESTINATION ${documents} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vspring)
set(CPACK_PACKAGE_CONTACT "the makers of vspring <vspring@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/changelog.Debian
  "vspring (${debian_version}) unstable; urgency=medium\n\n  * What changed is in changelog.gz.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
file(ARCHIVE_CREATE OUTPUT ${PROJECT_BINARY_DIR}/changelog.Debian.gz PATHS ${PROJECT_BINARY_DIR}/changelog.Debian
  FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
file(ARCHIVE_CREATE OUTPUT ${PROJECT_BINARY_DIR}/changelog.gz PATHS ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)

debian_package(program vspring graphics "fair curves and surfaces by a discrete spring model"
  "This is the program, with its editor for the browser."
  SHLIBDEPS ON RECOMMENDS xdg-utils SUGGESTS chromium)
set(needed "libeigen3-dev (>= 3.4), libfmt-dev (>= 9)")
if(BUILD_SHARED_LIBS)
  string(PREPEND needed "${library_package} (= ${debian_version}), ")
  file(WRITE ${PROJECT_BINARY_DIR}/shlibs "libvspring ${vspring_soversion} ${library_package} (>= ${PROJECT_VERSION})\n")
  debian_package(library ${library_package} libs "fair curves and surfaces - shared library"
    "This is the library of the program, for others."
    SHLIBDEPS ON)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/shlibs ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
endif()
debian_package(development libvspring-dev libdevel "fair curves and surfaces - headers and static library"
  "This is what programs in C++20 are built with."
  DEPENDS ${needed})
if(VSPRING_BUILD_PYTHON)
  # The module is built for one minor version of Python.
  math(EXPR next_minor "${vspring_python_minor} + 1")
  set(scripts ${PROJECT_SOURCE_DIR}/cmake/debian/python)
  debian_package(python python3-vspring python "fair curves and surfaces - Python module"
    "This is the module for arrays of NumPy."
    SHLIBDEPS ON DEPENDS "python3 (>= 3.${vspring_python_minor}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm)
endif()

include(CPack)
