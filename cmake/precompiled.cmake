# Headers that nearly every source includes, compiled once for each target: reading them takes a large part of the time of a build.
# ISOATLAS_PRECOMPILE=OFF compiles every source alone, as a test does for the public headers.
option(ISOATLAS_PRECOMPILE "Precompile common headers" ON)

function(isoatlas_precompile target)
  if(ISOATLAS_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <span>
      <stdexcept> <string> <string_view> <utility> <variant> <vector> ${ARGN})
  endif()
endfunction()
