#include "field/cell.h"

#include <algorithm>

namespace isoatlas {
namespace {

void unite(std::array<std::uint8_t, 8>& region, int a, int b) {
    const std::uint8_t keep = std::min(region[a], region[b]);
    const std::uint8_t drop = std::max(region[a], region[b]);
    for (std::uint8_t& r : region) {
        if (r == drop) r = keep;
    }
}

bool same_region(int pattern, int joined, int f) {
    const std::array<std::uint8_t, 8> region = cell_regions(pattern, joined & ~(1 << f));
    const std::array<int, 4>& c = kFaceCorners[f];
    const int high = pattern >> c[0] & 1 ? 0 : 1;
    return region[c[high]] == region[c[high + 2]];
}

CellTable make_cell_table() {
    CellTable table{};
    for (int pattern = 0; pattern < 256; ++pattern) {
        for (int f = 0; f < 6; ++f) {
            if (!face_is_split(pattern, f)) continue;
            table.split[pattern] |= static_cast<std::uint8_t>(1 << f);
            for (int joined = 0; joined < 64; ++joined) {
                if (same_region(pattern, joined, f)) table.highs_joined[64 * pattern + joined] |= static_cast<std::uint8_t>(1 << f);
            }
        }
    }
    return table;
}

}  // namespace

std::array<std::uint8_t, 8> cell_regions(int pattern, int joined) {
    std::array<std::uint8_t, 8> region{};
    for (int k = 0; k < 8; ++k) region[k] = static_cast<std::uint8_t>(pattern >> k & 1 ? k : 8 + k);
    for (const std::array<int, 2>& edge : kEdgeCorners) {
        if ((pattern >> edge[0] & 1) == (pattern >> edge[1] & 1)) unite(region, edge[0], edge[1]);
    }
    for (int f = 0; f < 6; ++f) {
        if (!face_is_split(pattern, f)) continue;
        const std::array<int, 4>& c = kFaceCorners[f];
        const bool a_is_high = pattern >> c[0] & 1;
        const bool highs = joined >> f & 1;
        const int diagonal = a_is_high == highs ? 0 : 1;  // the diagonal that is joined across the face
        unite(region, c[diagonal], c[diagonal + 2]);
    }
    return region;
}

const CellTable& cell_table() {
    static const CellTable table = make_cell_table();
    return table;
}

}  // namespace isoatlas
