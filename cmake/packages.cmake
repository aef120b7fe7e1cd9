# `make package`: isoatlas (the command line), libisoatlas-dev (all libraries with headers) and python3-isoatlas, as Debian packages and as
# tarballs that unpack anywhere. What the programs link is found by dpkg-shlibdeps; who installs them needs no compiler and no npm.
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME isoatlas)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGE_CONTACT "The isoatlas developers <developers@isoatlas.invalid>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_FILE_NAME isoatlas-${PROJECT_VERSION}-${CMAKE_SYSTEM_PROCESSOR})  # the folder in the tarballs
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package_kind.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME isoatlas)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "ffmpeg, xdg-utils")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libisoatlas-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libtbb-dev, zlib1g-dev, libtiff-dev, libpugixml-dev, libhdf5-dev, libblosc-dev, liblz4-dev, libcurl4-openssl-dev, libdeflate-dev, \
libqhull-dev, libembree-dev, libwebp-dev, libmeshoptimizer-dev, libzstd-dev")
if(ISOATLAS_DICOM)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libgdcm-dev")
endif()
set(CPACK_ARCHIVE_RUNTIME_FILE_NAME isoatlas-${PROJECT_VERSION}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_ARCHIVE_DEVELOPMENT_FILE_NAME libisoatlas-dev-${PROJECT_VERSION}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-isoatlas)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-networkx, python3-meshio, python3-tqdm")
set(CPACK_ARCHIVE_PYTHON_FILE_NAME python3-isoatlas-${PROJECT_VERSION}-${CMAKE_SYSTEM_PROCESSOR})
include(CPack)
cpack_add_component_group(runtime DESCRIPTION "Which objects are in a scalar volume, and at which isovalues?\n\
Lists the topologically distinct objects of CT, MRI, microscopy and simulation volumes with the isovalues that show them, writes a page of \
pictures, watertight surfaces, label volumes and measures, and serves a viewer in the browser.")
cpack_add_component_group(development DESCRIPTION "C++20 libraries of isoatlas\nMerge trees, contour trees, surfaces, stores, pictures and \
the viewer's server as static libraries, with headers and a CMake package: find_package(isoatlas).")
cpack_add_component(cli GROUP runtime)
foreach(component IN ITEMS ${ISOATLAS_ALL_LIBRARIES} umbrella package)  # cpack takes `all` for all components, the command line too
  cpack_add_component(${component} GROUP development)
endforeach()
if(ISOATLAS_PYTHON)
  cpack_add_component_group(python DESCRIPTION "Python package of isoatlas\n\
The objects of arrays and files, closed surfaces and labels as arrays of numpy.")
  cpack_add_component(python_package GROUP python)
endif()
