# The libraries of isoatlas. Each is made of rooms, the folders of src/, in the order in which data flows through them: a room may include the
# rooms before it, of its own library and of those it needs, nothing else (tests/layering).

# isoatlas_library(name NEEDS libraries LINKS other libraries INCLUDES their headers): begins a library, isoatlas::name.
# isoatlas_room(folder): adds src/folder/*.cpp to the library that was begun last.
# LINKS and INCLUDES are private: none of them shows in a public header; a static library still passes LINKS on to the linker.
function(isoatlas_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "NEEDS;LINKS;INCLUDES")
  set(target isoatlas_${name})
  add_library(${target} STATIC)
  add_library(isoatlas::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_include_directories(${target} SYSTEM PRIVATE ${arg_INCLUDES})
  list(TRANSFORM arg_NEEDS PREPEND isoatlas_)
  target_link_libraries(${target} PUBLIC ${arg_NEEDS} PRIVATE $<BUILD_INTERFACE:isoatlas_flags> ${arg_LINKS})
  if(ISOATLAS_SANITIZE)
    target_link_options(${target} PUBLIC -fsanitize=${ISOATLAS_SANITIZE})
  endif()
  set_property(GLOBAL APPEND PROPERTY ISOATLAS_LIBRARIES ${target})
  set_property(GLOBAL PROPERTY ISOATLAS_LAST_LIBRARY ${target})
endfunction()

function(isoatlas_room folder)
  get_property(target GLOBAL PROPERTY ISOATLAS_LAST_LIBRARY)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/${folder}/*.cpp)
  target_sources(${target} PRIVATE ${sources})
endfunction()
