#include "critical/open_tunnel.h"

#include <vector>

#include "critical/bodies.h"
#include "critical/tunnels.h"

namespace isoatlas {
namespace {

std::uint8_t region_of(const std::array<std::uint8_t, 8>& region, int corner) {
    unsigned corners = 0;
    for (int k = 0; k < 8; ++k) corners |= unsigned{region[k] == region[corner]} << k;
    return static_cast<std::uint8_t>(corners);
}

bool holds(int pattern, int joined) {
    const std::array<std::uint8_t, 8> region = cell_regions(pattern, joined);
    for (int a = 0; a < 8; ++a) {
        for (int b = a + 1; b < 8; ++b) {
            if (((pattern >> a ^ pattern >> b) & 1) != 0 || region[a] == region[b]) continue;
            for (int ring = 0; ring < 8; ++ring) {
                if (((pattern >> a ^ pattern >> ring) & 1) == 0) continue;
                if (tunnel_fits(region_of(region, a), region_of(region, b), region_of(region, ring))) return true;
            }
        }
    }
    return false;
}

}  // namespace

bool may_hold_tunnel(int pattern, int joined) {
    static const std::vector<std::uint8_t> table = [] {
        std::vector<std::uint8_t> result(256 * 64);
        for (int p = 0; p < 256; ++p) {
            for (int j = 0; j < 64; ++j) result[64 * p + j] = holds(p, j);
        }
        return result;
    }();
    return table[64 * pattern + joined] != 0;
}

template <class T>
std::array<double, 8> TunnelFinder<T>::values(std::int64_t cell) const {
    std::array<double, 8> value{};
    for (int k = 0; k < 8; ++k) value[k] = static_cast<double>(grid_.samples[steps_.cell_corner(cell, k)]);
    return value;
}

template <class T>
std::optional<OpenTunnel> TunnelFinder<T>::find(std::int64_t cell, int pattern, int joined) const {
    CellElements elements{values(cell), {}, 0, 0, {}};
    for (int k = 0; k < 8; ++k) elements.voxel[k] = steps_.cell_corner(cell, k);
    find_ambiguous_faces(elements);
    const CellBodies bodies = bodies_of_cell(elements, default_face_types(elements), tunnel_height_);
    const auto opened = [&](const BodyPoint& body, bool joins_highs) {
        const std::array<std::uint8_t, 8> region = cell_regions(pattern, joined);
        return OpenTunnel{joins_highs, region_of(region, body.region_a), region_of(region, body.region_b), region_of(region, body.ring),
                          body.position};
    };
    if (bodies.opening && bodies.opening->value >= tau_ && tau_ > elements.face_value[bodies.opening->face])
        return opened(*bodies.opening, true);
    if (bodies.closing && elements.face_value[bodies.closing->face] >= tau_ && tau_ > bodies.closing->value)
        return opened(*bodies.closing, false);
    return std::nullopt;
}

template class TunnelFinder<std::uint8_t>;
template class TunnelFinder<std::int8_t>;
template class TunnelFinder<std::uint16_t>;
template class TunnelFinder<std::int16_t>;
template class TunnelFinder<std::uint32_t>;
template class TunnelFinder<std::int32_t>;
template class TunnelFinder<float>;
template class TunnelFinder<double>;

}  // namespace isoatlas
