# Run by CTest: SOURCE consumer, BUILD the finished build, WORK a scratch folder.
cmake_minimum_required(VERSION 3.25)

# run(NAME COMMAND...): the output of the command lands in `output`; a failure ends the test with it.
function(run name)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE errors WORKING_DIRECTORY ${WORK})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${name} failed (${code})\n${text}\n${errors}")
  endif()
  set(output "${text}" PARENT_SCOPE)
endfunction()

function(require condition_name)
  if(NOT (${ARGN}))
    message(FATAL_ERROR "${condition_name} does not hold\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(prefix ${WORK}/prefix)
run("install" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run("configure the consumer" ${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/consumer -G ${GENERATOR}
  -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=Release)
run("build the consumer" ${CMAKE_COMMAND} --build ${WORK}/consumer)
run("the consumer" ${WORK}/consumer/consumer)
require("the consumer found objects" output MATCHES "voxel [0-9]+: best at")
require("the consumer wrote a surface" EXISTS ${WORK}/surface.ply)

run("the installed command line" ${prefix}/${BINDIR}/isoatlas --version)
require("it knows its version" output MATCHES "${VERSION}")

# Nothing of the source tree may shine through: the package must survive a move to another machine.
file(GLOB_RECURSE exported ${prefix}/*.cmake)
foreach(path IN LISTS exported)
  file(READ ${path} text)
  cmake_path(GET SOURCE PARENT_PATH tests_folder)
  cmake_path(GET tests_folder PARENT_PATH tests_folder)
  cmake_path(GET tests_folder PARENT_PATH source_root)
  string(FIND "${text}" "${source_root}/" position)
  if(NOT position EQUAL -1)
    message(FATAL_ERROR "${path} mentions the source folder ${source_root}")
  endif()
endforeach()
file(GLOB public_headers ${prefix}/include/isoatlas/*.h)
require("the public headers are installed" public_headers MATCHES "isoatlas.h")
