#include "measures/symmetric_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "measures/vectors.h"

namespace isoatlas {
namespace {

/// One rotation that makes matrix[p][q] zero; vectors: rows.
void rotate(Mat3& matrix, Mat3& vectors, std::size_t p, std::size_t q) {
    const double off = matrix[p][q];
    if (off == 0) return;
    const double theta = (matrix[q][q] - matrix[p][p]) / (2 * off);
    const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = matrix[k][p], b = matrix[k][q];
        matrix[k][p] = c * a - s * b;
        matrix[k][q] = s * a + c * b;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = matrix[p][k], b = matrix[q][k];
        matrix[p][k] = c * a - s * b;
        matrix[q][k] = s * a + c * b;
        const double x = vectors[p][k], y = vectors[q][k];
        vectors[p][k] = c * x - s * y;
        vectors[q][k] = s * x + c * y;
    }
    matrix[p][q] = matrix[q][p] = 0;
}

}  // namespace

SymmetricAxes symmetric_axes(Mat3 matrix) {
    constexpr int kSweeps = 50;  // each at least halves what is left; six are enough nearly always
    Mat3 vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        if (matrix[0][1] == 0 && matrix[0][2] == 0 && matrix[1][2] == 0) break;
        rotate(matrix, vectors, 0, 1);
        rotate(matrix, vectors, 0, 2);
        rotate(matrix, vectors, 1, 2);
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return matrix[a][a] > matrix[b][b]; });
    SymmetricAxes axes;
    for (std::size_t i = 0; i < 3; ++i) {
        axes.direction[i] = vectors[order[i]];
        axes.value[i] = matrix[order[i]][order[i]];
    }
    axes.direction[0] = pointed(axes.direction[0]);
    axes.direction[1] = pointed(axes.direction[1]);
    axes.direction[2] = cross(axes.direction[0], axes.direction[1]);
    return axes;
}

}  // namespace isoatlas
