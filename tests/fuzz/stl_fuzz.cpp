// The STL parser takes any bytes: an Error or a well-formed mesh.
#include "fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::parse_mesh(isoatlas::parse_stl, data, size);
}
