#include "critical/tunnels.h"

#include <algorithm>
#include <array>
#include <vector>

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

}  // namespace

bool tunnel_fits(unsigned a, unsigned b, unsigned ring) {
    static const std::vector<unsigned> keys = all_shapes();
    return std::binary_search(keys.begin(), keys.end(), key(a, b, ring));
}

}  // namespace isoatlas
