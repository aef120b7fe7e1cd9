#include "formats/mesh/gltf_frame.h"

#include <algorithm>
#include <cmath>

#include "formats/common/length_unit.h"
#include "formats/common/volume_file.h"

namespace isoatlas {

namespace {

constexpr double kMillimetre = 1e-3;

}  // namespace

GltfMatrix gltf_frame(const std::string& space, const std::string& unit) {
    const double metres = metres_in(unit).value_or(kMillimetre);
    const bool to_right = is_anatomical(space) && space[0] == 'R', to_front = is_anatomical(space) && space[1] == 'A';
    GltfMatrix matrix{};
    matrix[0] = to_right ? -metres : metres;  // x of the volume to x
    matrix[6] = to_front ? metres : -metres;  // y to z
    matrix[9] = metres;                       // z to y
    matrix[15] = 1;
    return matrix;
}

bool is_same_matrix(const GltfMatrix& a, const GltfMatrix& b) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < 15; ++i) {
        largest = std::max(largest, std::abs(a[i]));
        difference = std::max(difference, std::abs(a[i] - b[i]));
    }
    return difference <= 1e-6 * largest;
}

}  // namespace isoatlas
