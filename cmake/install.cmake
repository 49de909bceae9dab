# What `cmake --install` puts in place: headers, CMake package, program, case files, licence.
include(CMakePackageConfigHelpers)

# The package holds headers alone, hence the folder for files that fit every architecture.
set(HOLDFAST_PACKAGE_DIR ${CMAKE_INSTALL_DATADIR}/cmake/holdfast)

install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(TARGETS holdfast EXPORT holdfast_targets)
install(EXPORT holdfast_targets
  FILE holdfast-targets.cmake
  NAMESPACE holdfast::
  DESTINATION ${HOLDFAST_PACKAGE_DIR})

# The compiled part is of one architecture, so it has an export of its own beside its library.
set(HOLDFAST_COMPILED_TARGETS_FILE "")
if(TARGET holdfast_compiled)
  set(HOLDFAST_COMPILED_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/holdfast)
  set(HOLDFAST_COMPILED_TARGETS_FILE ${HOLDFAST_COMPILED_DIR}/holdfast-compiled-targets.cmake)
  install(TARGETS holdfast_compiled EXPORT holdfast_compiled_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT holdfast_compiled_targets
    FILE holdfast-compiled-targets.cmake
    NAMESPACE holdfast::
    DESTINATION ${HOLDFAST_COMPILED_DIR})
  export(EXPORT holdfast_compiled_targets
    FILE ${PROJECT_BINARY_DIR}/holdfast-compiled-targets.cmake
    NAMESPACE holdfast::)
  configure_file(cmake/holdfast-compiled.pc.in holdfast-compiled.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/holdfast-compiled.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()

configure_package_config_file(cmake/holdfast-config.cmake.in holdfast-config.cmake
  INSTALL_DESTINATION ${HOLDFAST_PACKAGE_DIR}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(holdfast-config-version.cmake
  COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)
install(FILES
  cmake/holdfast-adapters.cmake
  ${PROJECT_BINARY_DIR}/holdfast-config.cmake
  ${PROJECT_BINARY_DIR}/holdfast-config-version.cmake
  DESTINATION ${HOLDFAST_PACKAGE_DIR})

# The build folder serves as a package too: -D holdfast_DIR=BUILD.
export(EXPORT holdfast_targets
  FILE ${PROJECT_BINARY_DIR}/holdfast-targets.cmake
  NAMESPACE holdfast::)
configure_file(cmake/holdfast-adapters.cmake ${PROJECT_BINARY_DIR}/holdfast-adapters.cmake COPYONLY)

configure_file(cmake/holdfast.pc.in holdfast.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/holdfast.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)

if(TARGET holdfast_executable)
  install(TARGETS holdfast_executable DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/holdfast)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Where it was built.
install(FILES ${PROJECT_SOURCE_DIR}/build/wasm/explorer.html
  DESTINATION ${CMAKE_INSTALL_DATADIR}/holdfast OPTIONAL)
