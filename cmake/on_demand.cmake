# The parts of isoatlas whose libraries take long to load, as libraries of their own beside a program: LIBDIR/isoatlas/NAME-VERSION.so.
# isoatlas_loads_on_demand(program): the program loads them when it needs them, in place of linking them. With sanitizers it links them.
file(RELATIVE_PATH ISOATLAS_PARTS_FOLDER ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/isoatlas)

set(isoatlas_parts "")
if(ISOATLAS_DICOM)
  list(APPEND isoatlas_parts gdcm)
endif()
if(ISOATLAS_OPENVDB)
  list(APPEND isoatlas_parts openvdb)
endif()
if(ISOATLAS_SANITIZE)
  set(isoatlas_parts "")
endif()

# Sources of a part that no program has otherwise: not compiled twice. All else is the program's.
set(isoatlas_gdcm_objects "/dicom_gdcm[.]")
set(isoatlas_openvdb_objects "/vdb_(openvdb|file|tree)[.]")
foreach(part IN LISTS isoatlas_parts)
  string(TOUPPER ${part} name)
  add_library(isoatlas_part_${part} MODULE src/formats/on_demand/${part}_part.cpp
    $<FILTER:$<TARGET_OBJECTS:isoatlas_formats>,INCLUDE,${isoatlas_${part}_objects}>)
  target_include_directories(isoatlas_part_${part} PRIVATE src include)
  target_link_libraries(isoatlas_part_${part} PRIVATE isoatlas_flags ${ISOATLAS_${name}_TARGETS})
  set_target_properties(isoatlas_part_${part} PROPERTIES PREFIX "" OUTPUT_NAME ${part}-${PROJECT_VERSION}
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin/${ISOATLAS_PARTS_FOLDER})
  install(TARGETS isoatlas_part_${part} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/isoatlas COMPONENT cli)
endforeach()

function(isoatlas_loads_on_demand program)
  if(NOT isoatlas_parts)
    return()
  endif()
  target_sources(${program} PRIVATE ${PROJECT_SOURCE_DIR}/src/formats/on_demand/load_part.cpp)
  foreach(part IN LISTS isoatlas_parts)
    target_sources(${program} PRIVATE ${PROJECT_SOURCE_DIR}/src/formats/on_demand/${part}_on_demand.cpp)
    add_dependencies(${program} isoatlas_part_${part})
  endforeach()
  target_include_directories(${program} PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(${program} PRIVATE ISOATLAS_PARTS_FOLDER="${ISOATLAS_PARTS_FOLDER}")
  set_target_properties(${program} PROPERTIES ENABLE_EXPORTS ON)
  target_link_libraries(${program} PRIVATE ${CMAKE_DL_LIBS})
  target_link_options(${program} PRIVATE LINKER:--as-needed)
endfunction()
