# Read by cpack for each kind of package: tarballs hold one folder, Debian packages begin at the root.
if(CPACK_GENERATOR STREQUAL TGZ)
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
endif()
