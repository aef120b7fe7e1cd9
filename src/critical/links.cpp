#include "critical/links.h"

namespace isoatlas {
namespace {

/// Rows around a row; a missing one points to the row itself and its bit is masked out.
template <class T>
struct Rows {
    const T* row;
    const T* y_minus;
    const T* y_plus;
    const T* z_minus;
    const T* z_plus;
    std::uint8_t present;  // bits of the neighbours that exist
};

template <class T>
Rows<T> rows_at(const GridView<T>& grid, std::int64_t y, std::int64_t z) {
    const T* row = grid.row(y, z);
    Rows<T> rows{row, row, row, row, row, 0b000011};
    if (y > 0) rows.y_minus = grid.row(y - 1, z), rows.present |= 4;
    if (y + 1 < grid.extent.size[1]) rows.y_plus = grid.row(y + 1, z), rows.present |= 8;
    if (z > 0) rows.z_minus = grid.row(y, z - 1), rows.present |= 16;
    if (z + 1 < grid.extent.size[2]) rows.z_plus = grid.row(y, z + 1), rows.present |= 32;
    return rows;
}

// One expression per voxel without branches: the compiler turns the loop into vector code.
template <class T>
void links_of_row(const Rows<T>& rows, std::int64_t n, std::uint8_t* __restrict links) {
    const auto at = [&rows](std::int64_t x, bool left, bool right) {
        const T v = rows.row[x];
        const auto link = static_cast<std::uint8_t>(left | right << 1 | (rows.y_minus[x] > v) << 2 | (rows.y_plus[x] >= v) << 3 |
                                                    (rows.z_minus[x] > v) << 4 | (rows.z_plus[x] >= v) << 5);
        return static_cast<std::uint8_t>(link & rows.present);
    };
    if (n == 1) {
        links[0] = at(0, false, false);
        return;
    }
    links[0] = at(0, false, rows.row[1] >= rows.row[0]);
    for (std::int64_t x = 1; x < n - 1; ++x) links[x] = at(x, rows.row[x - 1] > rows.row[x], rows.row[x + 1] >= rows.row[x]);
    links[n - 1] = at(n - 1, rows.row[n - 2] > rows.row[n - 1], false);
}

}  // namespace

template <class T>
void links_of_slice(const GridView<T>& grid, std::int64_t z, std::span<std::uint8_t> links) {
    const std::int64_t n = grid.extent.size[0];
    for (std::int64_t y = 0; y < grid.extent.size[1]; ++y) links_of_row(rows_at(grid, y, z), n, links.data() + y * n);
}

template void links_of_slice(const GridView<std::uint8_t>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<std::int8_t>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<std::uint16_t>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<std::int16_t>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<std::uint32_t>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<std::int32_t>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<float>&, std::int64_t, std::span<std::uint8_t>);
template void links_of_slice(const GridView<double>&, std::int64_t, std::span<std::uint8_t>);

}  // namespace isoatlas
