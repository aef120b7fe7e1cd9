# The libraries of isoatlas. Each is made of rooms, the folders of src/, in the order in which data flows through them: a room may include the
# rooms before it, of its own library and of those it needs, nothing else (tests/layering).
include(cmake/isoatlasPackages.cmake)

set(ISOATLAS_ALL_LIBRARIES core formats remote store measures render methods server phantom verify)
set(ISOATLAS_LIBRARIES ${ISOATLAS_ALL_LIBRARIES} CACHE STRING "Libraries to build, with all that they need")

# isoatlas_library(name NEEDS libraries LINKS packages INCLUDES folders HEADERS names): begins a library, isoatlas::name, unless
# ISOATLAS_LIBRARIES leaves it out.
# isoatlas_room(folder): adds src/folder/*.cpp to the library that was begun last.
# LINKS and INCLUDES are private: none of them shows in a public header; a static library still passes LINKS on to the linker.
# HEADERS: its public headers, include/isoatlas/NAME.h; they are installed with it, as the install component of its name.
function(isoatlas_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "NEEDS;LINKS;INCLUDES;HEADERS")
  set(target isoatlas_${name})
  set_property(GLOBAL PROPERTY ISOATLAS_LAST_LIBRARY "")
  if(NOT name IN_LIST ISOATLAS_LIBRARIES)
    return()
  endif()
  foreach(needed IN LISTS arg_NEEDS)
    if(NOT TARGET isoatlas_${needed})
      message(FATAL_ERROR "ISOATLAS_LIBRARIES names ${name} but not ${needed}, which ${name} needs")
    endif()
  endforeach()
  add_library(${target} STATIC)
  add_library(isoatlas::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_include_directories(${target} SYSTEM PRIVATE ${arg_INCLUDES})
  list(TRANSFORM arg_NEEDS PREPEND isoatlas_ OUTPUT_VARIABLE needed)
  target_link_libraries(${target} PUBLIC ${needed} PRIVATE $<BUILD_INTERFACE:isoatlas_flags> ${arg_LINKS})
  if(ISOATLAS_SANITIZE)
    target_link_options(${target} PUBLIC -fsanitize=${ISOATLAS_SANITIZE})
  endif()
  list(TRANSFORM arg_HEADERS REPLACE "(.+)" "include/isoatlas/\\1.h")
  set_target_properties(${target} PROPERTIES ISOATLAS_NEEDS "${arg_NEEDS}" ISOATLAS_HEADERS "${arg_HEADERS}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ISOATLAS_UNITY} UNITY_BUILD_MODE GROUP)
  isoatlas_precompile(${target} "${PROJECT_SOURCE_DIR}/include/isoatlas/volume.h")
  set_property(GLOBAL APPEND PROPERTY ISOATLAS_LIBRARIES ${target})
  set_property(GLOBAL PROPERTY ISOATLAS_LAST_LIBRARY ${target})
endfunction()

function(isoatlas_room folder)
  get_property(target GLOBAL PROPERTY ISOATLAS_LAST_LIBRARY)
  if(target)
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${folder}/*.cpp)
    target_sources(${target} PRIVATE ${sources})
    if(NOT folder IN_LIST ISOATLAS_KERNEL_ROOMS)
      set_source_files_properties(${sources} PROPERTIES UNITY_GROUP ${folder})
    endif()
  endif()
endfunction()

foreach(library IN LISTS ISOATLAS_LIBRARIES)
  if(NOT library IN_LIST ISOATLAS_ALL_LIBRARIES)
    message(FATAL_ERROR "ISOATLAS_LIBRARIES names '${library}', which is not one of ${ISOATLAS_ALL_LIBRARIES}")
  endif()
  isoatlas_find_packages(${library})
  if(isoatlas_missing)
    list(JOIN isoatlas_missing ", " isoatlas_missing)
    list(JOIN ISOATLAS_ALL_LIBRARIES " " all)
    message(FATAL_ERROR "isoatlas::${library} needs ${isoatlas_missing}. Install what scripts/bootstrap.sh --list shows, "
      "or choose other libraries: -DISOATLAS_LIBRARIES=core (or some of ${all}, separated by semicolons)")
  endif()
endforeach()
# Headers alone.
if(core IN_LIST ISOATLAS_LIBRARIES)
  find_path(BOOST_INCLUDE_DIR boost/multiprecision/cpp_int.hpp REQUIRED)
endif()
if(store IN_LIST ISOATLAS_LIBRARIES OR remote IN_LIST ISOATLAS_LIBRARIES)
  find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
endif()
if(server IN_LIST ISOATLAS_LIBRARIES)
  find_path(BEAST_INCLUDE_DIR boost/beast/http/basic_parser.hpp REQUIRED)
endif()
