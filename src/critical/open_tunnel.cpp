#include "critical/open_tunnel.h"

#include "base/check.h"
#include "base/sample_types.h"
#include "critical/bodies.h"
#include "critical/tunnels.h"
#include "field/order.h"

namespace isoatlas {

template <class T>
std::array<double, 8> TunnelFinder<T>::values(const Index3& cell) const {
    std::array<double, 8> value{};
    for (int k = 0; k < 8; ++k) value[k] = static_cast<double>(grid_.corner(cell, k));
    return value;
}

template <class T>
std::optional<OpenTunnel> TunnelFinder<T>::find(const Index3& cell, int pattern, int joined) const {
    CellElements elements{values(cell), {}, 0, 0, {}};
    const GridSteps steps(grid_.extent);
    for (int k = 0; k < 8; ++k) elements.voxel[k] = steps.cell_corner(grid_.extent.index(cell), k);
    find_ambiguous_faces(elements);
    const CellBodies bodies = bodies_of_cell(elements, default_face_types(elements), tunnel_height_);
    const auto opened = [&](const BodyPoint& body, bool joins_highs) {
        const TunnelShape& shape = tunnel_shape(pattern, joined, joins_highs);
        ISOATLAS_CHECK(shape.exists());
        return OpenTunnel{joins_highs, shape.a, shape.b, shape.ring, body.position};
    };
    if (bodies.opening && bodies.opening->value >= tau_ && tau_ > elements.face_value[bodies.opening->face])
        return opened(*bodies.opening, true);
    if (bodies.closing && elements.face_value[bodies.closing->face] >= tau_ && tau_ > bodies.closing->value)
        return opened(*bodies.closing, false);
    return std::nullopt;
}

#define ISOATLAS_INSTANTIATE(T) template class TunnelFinder<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
