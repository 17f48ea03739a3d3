include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(layer_targets GLOBAL PROPERTY SKEIN_LAYER_TARGETS)
install(TARGETS ${layer_targets} EXPORT skeinTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS skein RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/skein DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY tools/plots DESTINATION ${CMAKE_INSTALL_DATADIR}/skein FILES_MATCHING PATTERN "*.py")
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/skein)
install(EXPORT skeinTargets NAMESPACE skein:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
configure_package_config_file(cmake/skeinConfig.cmake.in ${CMAKE_BINARY_DIR}/skeinConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/Dependencies.cmake ${CMAKE_BINARY_DIR}/skeinConfig.cmake ${CMAKE_BINARY_DIR}/skeinConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/skein)
