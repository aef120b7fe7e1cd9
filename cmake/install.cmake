# install + find_package(isoatlas COMPONENTS ...): each library with its public headers is an install component of its name; the command line
# is `cli`. `cmake --install BUILD --component core` installs isoatlas::core alone (and `package`, which all of them need).
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/isoatlas)
set(ISOATLAS_NEEDS_LINES "")  # for isoatlasConfig.cmake
foreach(library IN LISTS ISOATLAS_ALL_LIBRARIES)
  if(TARGET isoatlas_${library})
    get_target_property(headers isoatlas_${library} ISOATLAS_HEADERS)
    get_target_property(needs isoatlas_${library} ISOATLAS_NEEDS)
    string(APPEND ISOATLAS_NEEDS_LINES "set(isoatlas_${library}_NEEDS ${needs})\n")
    install(TARGETS isoatlas_${library} EXPORT isoatlas_${library} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${library})
    install(EXPORT isoatlas_${library} NAMESPACE isoatlas:: FILE ${library}.cmake DESTINATION ${package_folder} COMPONENT ${library})
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/isoatlas COMPONENT ${library})
  endif()
endforeach()
if(has_all)
  install(FILES include/isoatlas/isoatlas.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/isoatlas COMPONENT umbrella)
endif()
set(built ${CMAKE_CURRENT_BINARY_DIR})
configure_package_config_file(cmake/isoatlasConfig.cmake.in ${built}/isoatlasConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${built}/isoatlasConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${built}/isoatlasConfig.cmake ${built}/isoatlasConfigVersion.cmake cmake/isoatlasPackages.cmake
  DESTINATION ${package_folder} COMPONENT package)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT package)
