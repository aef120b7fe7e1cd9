# Run by CTest: SOURCE the source tree, BUILD the finished build, WORK a scratch folder.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

# What is installed may be moved, also to a folder with a blank in its name.
run("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${prefix})
run("configure the consumer" ${configure} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK}/consumer)
run("build the consumer" ${CMAKE_COMMAND} --build ${WORK}/consumer)
run("the consumer" ${WORK}/consumer/consumer)
require("the consumer found objects" output MATCHES "voxel [0-9]+: best at")
require("the consumer wrote a surface" EXISTS ${WORK}/surface.ply)

run("the installed command line" ${prefix}/${BINDIR}/isoatlas --version)
require("it knows its version" output MATCHES "${VERSION}")

foreach(file IN ITEMS man/man1/isoatlas.1 man/man1/isoatlas-extract.1 bash-completion/completions/isoatlas zsh/vendor-completions/_isoatlas
  fish/vendor_completions.d/isoatlas.fish isoatlas/paraview/isoatlas_paraview.py isoatlas/slicer/Isoatlas.py)
  require("${file} is installed" EXISTS ${prefix}/share/${file})
endforeach()

# A minor version may change names: another one is refused.
file(WRITE ${WORK}/other/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES CXX)\nfind_package(isoatlas 0.1 REQUIRED COMPONENTS core)\n")
refuse("a consumer of another minor version" ${configure} -S ${WORK}/other -B ${WORK}/other/build)
require("the refusal names the version" output MATCHES "requested version .?0.1")

# Where a library is missing, the message says what Debian calls it.
file(WRITE ${WORK}/lacking/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(lacking LANGUAGES CXX)\nfind_package(isoatlas REQUIRED COMPONENTS formats store render)\n")
refuse("a consumer without the libraries" ${configure} -D CMAKE_PROJECT_INCLUDE=${CMAKE_CURRENT_LIST_DIR}/only_tbb.cmake -S ${WORK}/lacking
  -B ${WORK}/lacking/build)
require("the refusal names what is missing" output MATCHES "isoatlas::formats needs ZLIB, TIFF, PNG, JPEG, pugixml, hdf5.h.*isoatlas::store needs")
require("and what to install, each package once" output MATCHES
  "apt-get install zlib1g-dev libtiff-dev libpng-dev libjpeg-dev libpugixml-dev libhdf5-dev libblosc-dev libzstd-dev liblz4-dev libbz2-dev libdraco-dev (libgdcm-dev )?(libopenvdb-dev libimath-dev )?libdeflate-dev libembree-dev libwebp-dev( |$)")

# The package must survive a move to another machine: no path of this one, neither of folders of ours nor of the system's libraries.
file(GLOB_RECURSE exported ${prefix}/*.cmake)
list(LENGTH exported count)
require("there are package files" count GREATER 10)
foreach(path IN LISTS exported)
  file(STRINGS ${path} absolute REGEX "(^|[ \"';:=(])/[A-Za-z]")
  list(FILTER absolute EXCLUDE REGEX "^ *#")
  set(output "${path}: ${absolute}")
  require("no absolute path in a package file" NOT absolute)
endforeach()
file(GLOB installed RELATIVE ${prefix}/include ${prefix}/include/isoatlas/*.h)
file(GLOB headers RELATIVE ${SOURCE}/include ${SOURCE}/include/isoatlas/*.h)
set(output "${installed}")
require("every public header belongs to a library" headers STREQUAL installed)
