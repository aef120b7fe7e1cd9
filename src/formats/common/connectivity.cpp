#include "formats/common/connectivity.h"

#include "isoatlas/output.h"

namespace isoatlas {

KeyValues key_values(const Connectivity& connectivity) {
    KeyValues pairs{{"interpolant", connectivity.name()}};
    if (connectivity.has_tunnels()) pairs.emplace_back("tunnel_height", number_text(connectivity.tunnel_height));
    if (connectivity.is_low()) pairs.emplace_back("polarity", name_of(connectivity.polarity));
    return pairs;
}

void put_members(JsonStream& json, const Connectivity& connectivity) {
    json.key("interpolant").value(connectivity.name());
    if (connectivity.has_tunnels()) json.key("tunnel_height").value(connectivity.tunnel_height);
    if (connectivity.is_low()) json.key("polarity").value(name_of(connectivity.polarity));
}

std::string vtk_elements(AppendedArrays& arrays, const Connectivity& connectivity) {
    std::string text = vtk_string("Interpolant", connectivity.name());
    if (connectivity.is_low()) text += vtk_string("Polarity", name_of(connectivity.polarity));
    if (!connectivity.has_tunnels()) return text;
    const double height = connectivity.tunnel_height;
    return text + arrays.add<double>("TunnelHeight", 1, 1, [height](ByteWriter& out) { out.put(height); }, true);
}

std::string short_text(double value) {
    std::array<char, 32> digits;
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 7).ptr};
}

std::string describe(Interpolant interpolant, double tunnel_height) {
    const bool leaves_out = interpolant == Interpolant::trilinear && tunnel_height > 0;
    return name_of(interpolant) + (leaves_out ? ", tunnel height " + short_text(tunnel_height) : "");
}

}  // namespace isoatlas
