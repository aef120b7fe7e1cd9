# Headers that nearly every source includes, compiled once for each target: reading them takes a large part of the time of a build.
# ISOATLAS_PRECOMPILE=OFF compiles every source alone, as a test does for the public headers.
option(ISOATLAS_PRECOMPILE "Precompile common headers" ON)
# One translation unit a folder: a clean build takes less time, one after a change more. No two sources of a folder have a name in both
# unnamed namespaces, which scripts/lint.py checks. Rooms with inner loops stay apart: g++ inlines less where a unit is large.
option(ISOATLAS_UNITY "Compile the sources of a folder together" OFF)
set(ISOATLAS_KERNEL_ROOMS base geometry field critical tree zones analysis levelset mesh octree_front level_of_detail codec bricks render)
set(ISOATLAS_KERNEL_LIBRARIES core store measures render phantom)  # with inner loops, on which the time of the tests depends

# In builds for tests, what no test waits for is compiled with -O1: a quarter to a third less to compile. Further arguments: options with it.
function(isoatlas_compile_fast target)
  target_compile_options(${target} PRIVATE "$<$<CONFIG:RelWithDebInfo>:-O1;${ARGN}>")
endfunction()

function(isoatlas_precompile target)
  if(ISOATLAS_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <span>
      <stdexcept> <string> <string_view> <utility> <variant> <vector> ${ARGN})
  endif()
endfunction()
