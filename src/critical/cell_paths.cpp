#include "critical/cell_paths.h"

#include <algorithm>
#include <array>
#include <utility>

namespace isoatlas {
namespace {

bool are_neighbours(const CellElements& cell, int p, int q) {
    if (p > q) std::swap(p, q);
    if (q < 8) return (p ^ q) == 1 || (p ^ q) == 2 || (p ^ q) == 4;
    if (p >= 8) return false;
    const std::array<int, 4>& corner = kFaceCorners[q - 8];
    const int first = cell.bd_high >> (q - 8) & 1 ? 1 : 0;
    return p == corner[first] || p == corner[first + 2];  // its Lows are neighbours of its Highs
}

}  // namespace

std::vector<int> path_above_face(const CellElements& cell, int f, int from, int to) {
    std::array<int, 14> before;
    before.fill(-1);
    std::vector<int> found{from};
    before[from] = from;
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (int next = 0; next < 14; ++next) {
            const bool exists = next < 8 || (next != 8 + f && (cell.ambiguous >> (next - 8) & 1) != 0);
            if (!exists || before[next] >= 0 || !are_neighbours(cell, found[i], next) || !element_below(cell, 8 + f, next)) continue;
            before[next] = found[i];
            found.push_back(next);
        }
    }
    if (before[to] < 0) return {};
    std::vector<int> path{to};
    while (path.back() != from) path.push_back(before[path.back()]);
    std::ranges::reverse(path);
    return path;
}

}  // namespace isoatlas
