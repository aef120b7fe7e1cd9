#include "oracle/tunnels.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "critical/bodies.h"
#include "critical/open_tunnel.h"
#include "field/cell_loops.h"
#include "levelset/active_cells.h"

namespace oracle {
namespace {

using isoatlas::Extent;

/// The numbers of corners of the regions tell the shapes apart.
int shape_of(const isoatlas::OpenTunnel& tunnel) {
    constexpr std::array<std::array<int, 3>, 6> kCorners{{{1, 1, 6}, {1, 2, 5}, {1, 3, 4}, {2, 2, 4}, {1, 3, 3}, {1, 4, 3}}};
    const int a = std::popcount(tunnel.a), b = std::popcount(tunnel.b), ring = std::popcount(tunnel.ring);
    const std::array<int, 3> corners{std::min(a, b), std::max(a, b), ring};
    return static_cast<int>(std::ranges::find(kCorners, corners) - kCorners.begin());
}

template <class T>
std::optional<isoatlas::OpenTunnel> tunnel_of_cell(const isoatlas::SampleGrid<T>& grid, const isoatlas::Index3& cell, double tau) {
    int pattern = 0;
    for (int k = 0; k < 8; ++k) pattern |= int{static_cast<double>(grid.corner(cell, k)) >= tau} << k;
    if (pattern == 0 || pattern == 255) return std::nullopt;
    const int split = isoatlas::cell_cases().split_faces[pattern];
    const int joined = isoatlas::FaceJoiner<T>{grid, tau}.joined_mask(cell, pattern, split);
    return isoatlas::TunnelFinder<T>(grid, tau, 0)(cell, pattern, joined);
}

/// Which corners are inside the tunnel: one example of each shape.
constexpr std::array<int, 6> kInside{0b0001'1000, 0b0001'1001, 0b0001'1110, 0b0011'1100, 0b0110'1001, 0b0110'1011};

/// Life of the tunnels of a cell, if it has any.
std::optional<TunnelSample> with_life(const std::array<double, 8>& value, bool joins_highs) {
    isoatlas::CellElements cell{value, {0, 1, 2, 3, 4, 5, 6, 7}, 0, 0, {}};
    isoatlas::find_ambiguous_faces(cell);
    const isoatlas::CellBodies bodies = isoatlas::bodies_of_cell(cell, isoatlas::default_face_types(cell));
    const auto& body = joins_highs ? bodies.opening : bodies.closing;
    if (!body) return std::nullopt;
    const double face = cell.face_value[body->face];
    return TunnelSample{value, std::min(face, body->value), std::max(face, body->value)};
}

}  // namespace

std::array<std::int64_t, 6> count_tunnels(const isoatlas::Volume& volume, double tau) {
    std::array<std::int64_t, 6> count{};
    isoatlas::visit_grid(volume, [&](const auto& grid) {
        const auto& size = grid.extent.size;
        for (std::int64_t z = 0; z + 1 < size[2]; ++z) {
            for (std::int64_t y = 0; y + 1 < size[1]; ++y) {
                for (std::int64_t x = 0; x + 1 < size[0]; ++x) {
                    if (const auto tunnel = tunnel_of_cell(grid, {x, y, z}, tau)) ++count.at(shape_of(*tunnel));
                }
            }
        }
    });
    return count;
}

TunnelSample random_tunnel(int shape, bool joins_highs, std::mt19937_64& random) {
    std::uniform_real_distribution<double> magnitude(0, 1);
    for (;;) {
        std::array<double, 8> value{};
        const int turn = static_cast<int>(random() % 8);  // mirrored copies
        for (int k = 0; k < 8; ++k) {
            const bool high = ((kInside[shape] >> k & 1) != 0) == joins_highs;
            value[k ^ turn] = high ? magnitude(random) : -magnitude(random);
        }
        const std::optional<TunnelSample> sample = with_life(value, joins_highs);
        if (!sample) continue;
        const Extent extent{3, {2, 2, 2}};
        const isoatlas::SampleGrid<double> grid{value.data(), extent, isoatlas::SampleLayout::of_volume(extent)};
        const auto tunnel = tunnel_of_cell(grid, {0, 0, 0}, sample->low + (sample->high - sample->low) / 2);
        if (tunnel && tunnel->joins_highs == joins_highs && shape_of(*tunnel) == shape) return *sample;
    }
}

}  // namespace oracle
