#include "mesh/layout.h"

#include "base/prefetch.h"
#include "base/target_clones.h"

namespace isoatlas {

MeshDomain::MeshDomain(const HighBits& bits, Boundary boundary)
    : high(bits),
      cells(CellWindow::all(bits.extent().size[0])),
      y_begin(-1),
      y_end(bits.extent().size[1]),
      z_begin(-1),
      z_end(bits.extent().size[2]) {
    if (boundary == Boundary::open) {
        cells = CellWindow::real(bits.extent().size[0]);
        y_begin = z_begin = 0;
        --y_end;
        --z_end;
    }
    if (bits.extent().rank == 2) {  // one slice of squares: no edges along z
        z_begin = 0;
        z_end = 0;
    }
}

ISOATLAS_TARGET_CLONES void count_hits(const MeshDomain& domain, std::int64_t y, std::int64_t z, RowOffsets& place) {
    const RowHits hits(domain, y, z);
    hits.candidates.for_each([&](std::int64_t w) { count_hits(w, hits.x(w), hits.y(w), hits.z(w), place); });
}

void prefetch_rows(const MeshDomain& domain, const Layout& layout, std::int64_t y, std::int64_t end, std::int64_t z) {
    prefetch(domain.high.row(y, z), domain.high.row(end - 1, z) + domain.high.words());
    prefetch(&layout[static_cast<std::size_t>(domain.row_number(y, z))], &layout[static_cast<std::size_t>(domain.row_number(end, z))]);
}

void exclusive_scan_counts(Layout& layout) {
    std::int64_t point = 0, triangle = 0;
    for (RowOffsets& place : layout) {
        place.point = point;
        point += std::int64_t{place.x_hits} + place.y_hits + place.z_hits + place.articulation_points;
        const std::int64_t triangles = place.triangle;
        place.triangle = triangle;
        triangle += triangles;
    }
}

}  // namespace isoatlas
