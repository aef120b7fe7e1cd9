// In place of formats/volume/vdb_library.cpp.
#include "formats/on_demand/load_part.h"
#include "formats/volume/vdb_library.h"

namespace isoatlas {

const VdbLibrary& vdb_library(const std::string& file) {
    static const auto* const library = static_cast<const VdbLibrary*>(load_part("openvdb", "OpenVDB", file));
    return *library;
}

}  // namespace isoatlas
