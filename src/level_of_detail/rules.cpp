#include "level_of_detail/rules.h"

#include "geometry/triangles.h"

namespace isoatlas {

void mark_rims(const CollapsibleMesh& mesh, Array<std::uint16_t>& faces) {
    for (std::uint32_t point = 0; point < mesh.points(); ++point) {
        mesh.for_fan(point, [&](std::uint32_t corner) {
            const std::uint32_t next = mesh.point(next_corner(corner));
            bool is_inner = false;
            mesh.for_fan(point, [&](std::uint32_t other) { is_inner = is_inner || mesh.point(last_corner(other)) == next; });
            if (!is_inner) faces[point] |= kRim, faces[next] |= kRim;
        });
    }
}

void set_quadric(SurfaceState& state, std::uint32_t point) {
    state.mesh.for_fan(point, [&](std::uint32_t corner) {
        state.quadrics[point].add_triangle(minus(state.scaled[state.mesh.point(next_corner(corner))], state.scaled[point]),
                                           minus(state.scaled[state.mesh.point(last_corner(corner))], state.scaled[point]));
    });
}

}  // namespace isoatlas
