# Run by CTest: SOURCE the source tree, BUILD the finished build, WORK a scratch folder.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

run("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run("configure the consumer" ${configure} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK}/consumer)
run("build the consumer" ${CMAKE_COMMAND} --build ${WORK}/consumer)
run("the consumer" ${WORK}/consumer/consumer)
require("the consumer found objects" output MATCHES "voxel [0-9]+: best at")
require("the consumer wrote a surface" EXISTS ${WORK}/surface.ply)

run("the installed command line" ${prefix}/${BINDIR}/isoatlas --version)
require("it knows its version" output MATCHES "${VERSION}")

foreach(file IN ITEMS man/man1/isoatlas.1 man/man1/isoatlas-extract.1 bash-completion/completions/isoatlas zsh/vendor-completions/_isoatlas
  fish/vendor_completions.d/isoatlas.fish)
  require("${file} is installed" EXISTS ${prefix}/share/${file})
endforeach()

# A minor version may change names: another one is refused.
file(WRITE ${WORK}/other/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(other LANGUAGES CXX)\nfind_package(isoatlas 0.1 REQUIRED COMPONENTS core)\n")
refuse("a consumer of another minor version" ${configure} -S ${WORK}/other -B ${WORK}/other/build)
require("the refusal names the version" output MATCHES "requested version .?0.1")

# Nothing of the source tree may shine through: the package must survive a move to another machine.
file(GLOB_RECURSE exported ${prefix}/*.cmake)
foreach(path IN LISTS exported)
  file(READ ${path} text)
  string(FIND "${text}" "${SOURCE}/" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${path} mentions the source folder ${SOURCE}")
  endif()
endforeach()
file(GLOB installed RELATIVE ${prefix}/include ${prefix}/include/isoatlas/*.h)
file(GLOB headers RELATIVE ${SOURCE}/include ${SOURCE}/include/isoatlas/*.h)
set(output "${installed}")
require("every public header belongs to a library" headers STREQUAL installed)
