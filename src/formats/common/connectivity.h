// Connectivity in file headers: the interpolant, when it makes tunnels the height up to which they are ignored, and which objects there
// are: "polarity" "low" for those of low values; without it they are of high values.
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
    Polarity polarity = Polarity::high;

    [[nodiscard]] const char* name() const { return name_of(interpolant); }
    [[nodiscard]] bool is_low() const { return polarity == Polarity::low; }
    [[nodiscard]] bool has_tunnels() const { return interpolant == Interpolant::trilinear; }  ///< without tunnels no height is written
};
[[nodiscard]] inline Connectivity connectivity_of(const Surface& surface) {
    return {surface.interpolant, surface.reported_tunnel_height, surface.polarity};
}
/// tunnel_height: difference of stored values of this volume.
[[nodiscard]] inline Connectivity connectivity_of(const VolumeInfo& info, Interpolant interpolant, double tunnel_height) {
    return {interpolant, info.calibration.reported_difference(tunnel_height), polarity_of(info)};
}

[[nodiscard]] KeyValues key_values(const Connectivity& connectivity);
/// Members "interpolant", "tunnel_height" and "polarity" of the object that is open.
void put_members(JsonStream& json, const Connectivity& connectivity);
/// Arrays of field data "Interpolant", "TunnelHeight" and "Polarity".
[[nodiscard]] std::string vtk_elements(AppendedArrays& arrays, const Connectivity& connectivity);

/// Seven digits, for headers of limited length.
[[nodiscard]] std::string short_text(double value);

}  // namespace isoatlas
