// Connectivity in file headers: the interpolant and, when it makes tunnels, the height up to which they are ignored.
#pragma once

#include <string>

#include "formats/common/json_stream.h"
#include "formats/common/volume_file.h"
#include "formats/common/vtk_writer.h"
#include "isoatlas/surface.h"

namespace isoatlas {

struct Connectivity {
    Interpolant interpolant;
    double tunnel_height;  ///< calibrated

    [[nodiscard]] const char* name() const { return name_of(interpolant); }
    [[nodiscard]] bool has_tunnels() const { return interpolant == Interpolant::trilinear; }  ///< without tunnels no height is written
};
[[nodiscard]] inline Connectivity connectivity_of(const Surface& surface) { return {surface.interpolant, surface.reported_tunnel_height}; }

[[nodiscard]] KeyValues key_values(const Connectivity& connectivity);
/// Members "interpolant" and "tunnel_height" of the object that is open.
void put_members(JsonStream& json, const Connectivity& connectivity);
/// Arrays of field data "Interpolant" and "TunnelHeight".
[[nodiscard]] std::string vtk_elements(AppendedArrays& arrays, const Connectivity& connectivity);

/// Seven digits, for headers of limited length.
[[nodiscard]] std::string short_text(double value);

}  // namespace isoatlas
