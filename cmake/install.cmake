# install + find_package(isoatlas): the library, its public headers, the command line.
include(CMakePackageConfigHelpers)
install(TARGETS isoatlas ${ISOATLAS_LIBRARIES} EXPORT isoatlasTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/isoatlas DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT isoatlasTargets NAMESPACE isoatlas:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/isoatlas)
configure_package_config_file(cmake/isoatlasConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/isoatlasConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/isoatlas)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/isoatlasConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/isoatlasConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/isoatlasConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/isoatlas)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
