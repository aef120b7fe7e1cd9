#include "critical/tunnels.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/check.h"
#include "field/cell_loops.h"

namespace isoatlas {
namespace {

struct Shape {
    unsigned a, b, ring;
};
// Corner k = x + 2y + 4z. The cases of Marching Cubes 33: 4, 6, 12.1, 10.1, 13.5, 7.4.
constexpr std::array<Shape, 6> kShapes{{{0b0000'1000, 0b0001'0000, 0b1110'0111},
                                        {0b0000'1000, 0b0001'0001, 0b1110'0110},
                                        {0b0000'1110, 0b0001'0000, 0b1110'0001},
                                        {0b0000'1100, 0b0011'0000, 0b1100'0011},
                                        {0b0000'1000, 0b0110'0001, 0b1000'0110},
                                        {0b0010'1011, 0b0100'0000, 0b1001'0100}}};

constexpr unsigned key(unsigned a, unsigned b, unsigned ring) { return a | b << 8 | ring << 16; }

/// The image of a set of corners: axes permuted, then mirrored (bit per axis).
unsigned image(unsigned corners, const std::array<int, 3>& axes, int mirrored) {
    unsigned result = 0;
    for (int k = 0; k < 8; ++k) {
        int to = 0;
        for (int axis = 0; axis < 3; ++axis) to |= (k >> axis & 1) << axes[axis];
        result |= (corners >> k & 1) << (to ^ mirrored);
    }
    return result;
}

std::vector<unsigned> all_shapes() {
    std::vector<unsigned> keys;
    for (const Shape& shape : kShapes) {
        std::array<int, 3> axes{0, 1, 2};
        do {
            for (int mirrored = 0; mirrored < 8; ++mirrored) {
                const unsigned a = image(shape.a, axes, mirrored), b = image(shape.b, axes, mirrored);
                const unsigned ring = image(shape.ring, axes, mirrored);
                keys.push_back(key(a, b, ring));
                keys.push_back(key(b, a, ring));
            }
        } while (std::next_permutation(axes.begin(), axes.end()));
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

std::uint8_t region_of(const std::array<std::uint8_t, 8>& region, int corner) {
    unsigned corners = 0;
    for (int k = 0; k < 8; ++k) corners |= unsigned{region[k] == region[corner]} << k;
    return static_cast<std::uint8_t>(corners);
}

/// The shape of one class that fits into a case. keys: all_shapes.
TunnelShape find_shape(int pattern, int joined, bool joins_highs, const std::vector<unsigned>& keys) {
    const std::array<std::uint8_t, 8> region = cell_regions(pattern, joined);
    const unsigned joined_class = joins_highs ? static_cast<unsigned>(pattern) : ~static_cast<unsigned>(pattern);
    TunnelShape found;
    for (int a = 0; a < 8; ++a) {
        for (int b = 0; b < 8; ++b) {
            for (int ring = 0; ring < 8; ++ring) {
                if ((joined_class >> a & joined_class >> b & ~(joined_class >> ring) & 1) == 0 || region[a] >= region[b]) continue;
                const TunnelShape shape{region_of(region, a), region_of(region, b), region_of(region, ring)};
                if (!std::binary_search(keys.begin(), keys.end(), key(shape.a, shape.b, shape.ring))) continue;
                ISOATLAS_CHECK(!found.exists() || (found.joins(shape.a, shape.b) && found.ring == shape.ring));
                found = shape;
            }
        }
    }
    return found;
}

struct CaseShapes {
    std::array<TunnelShape, 2> of_class;  // Lows, Highs
};

std::vector<CaseShapes> shapes_of_cases() {
    const std::vector<unsigned> keys = all_shapes();
    const CellCaseTables& cases = cell_cases();
    std::vector<CaseShapes> shapes(kCellCases);
    for (int i = 0; i < kCellCases; ++i) {
        for (const bool joins_highs : {false, true})
            shapes[i].of_class[joins_highs] = find_shape(cases.pattern_of[i], cases.joined_of[i], joins_highs, keys);
    }
    return shapes;
}

const CaseShapes& shapes_of(int pattern, int joined) {
    static const CellCaseTables& cases = cell_cases();
    static const std::vector<CaseShapes> shapes = shapes_of_cases();
    return shapes[cases.case_of(pattern, joined)];
}

}  // namespace

const TunnelShape& tunnel_shape(int pattern, int joined, bool joins_highs) { return shapes_of(pattern, joined).of_class[joins_highs]; }

bool may_hold_tunnel(int pattern, int joined) {
    const CaseShapes& shapes = shapes_of(pattern, joined);
    return shapes.of_class[0].exists() || shapes.of_class[1].exists();
}

}  // namespace isoatlas
