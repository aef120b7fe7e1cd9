#include "mesh/squares.h"

#include "mesh/cells.h"

namespace isoatlas {
namespace {

/// The face z = 1 of a cell is seen from outside as an image is: its links, Highs to the right. Its corners are 4..7.
constexpr int kTopFace = 1;

bool is_split(int square) { return square == 0b1001 || square == 0b0110; }

}  // namespace

std::int64_t count_segments(const MeshDomain& domain, std::int64_t y) {
    std::int64_t segments = 0;
    for_active_cells(square_row(domain.high, y), domain.cells, [&](std::int64_t, int square) { segments += is_split(square) ? 2 : 1; });
    return segments;
}

template <class T>
void write_segments(const SampleGrid<T>& grid, double tau, const MeshDomain& domain, std::int64_t y, const Layout& layout, bool flip,
                    Surface& surface) {
    const FaceJoiner<T> joiner{grid, tau};
    const RowOffsets &near = layout[domain.row_number(y, 0)], &far = layout[domain.row_number(y + 1, 0)];
    std::array<std::int64_t, 2>* segment = surface.segments.data() + near.triangle;
    std::int64_t x_near = near.point, x_far = far.point, y_edge = near.first_y();
    for_active_cells(square_row(domain.high, y), domain.cells, [&](std::int64_t p, int square) {
        int joined = 0;
        if (is_split(square)) {
            const Diagonal highs = square & 1 ? Diagonal::ac : Diagonal::bd;
            joined = int{joiner({p - 1, y, 0}, 0, highs)} << kTopFace;
        }
        const int pattern = square << 4;
        const unsigned hit_edges = cell_cases().hit_edges[pattern];
        // Edges of the top face: 2 and 3 along x, 6 and 7 along y.
        const auto hit = [hit_edges](int e) { return static_cast<std::int64_t>(hit_edges >> e & 1); };
        std::array<std::int64_t, 12> point{};
        point[2] = x_near;
        point[3] = x_far;
        point[6] = y_edge;
        point[7] = y_edge + hit(6);
        x_near += hit(2);
        x_far += hit(3);
        y_edge += hit(6);
        const FaceLinks links = face_links(pattern, joined, kTopFace);
        for (int i = 0; i < links.count; ++i) {
            const std::int64_t from = point[links.link[i][0]], to = point[links.link[i][1]];
            *segment++ = flip ? std::array{from, to} : std::array{to, from};  // links have the Highs to the right
        }
    });
}

template void write_segments(const SampleGrid<std::uint8_t>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<std::int8_t>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<std::uint16_t>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<std::int16_t>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<std::uint32_t>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<std::int32_t>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<float>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);
template void write_segments(const SampleGrid<double>&, double, const MeshDomain&, std::int64_t, const Layout&, bool, Surface&);

}  // namespace isoatlas
