#include "critical/element_values.h"

#include <limits>
#include <optional>

#include "base/parallel.h"
#include "critical/bodies.h"
#include "critical/earlier_values.h"
#include "critical/faces.h"

namespace isoatlas {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Has this voxel a next sample along all these axes?
bool has_next(const Extent& extent, std::int64_t voxel, unsigned axes) {
    if (voxel < 0 || voxel >= extent.voxels()) return false;
    const Index3 at = extent.voxel(voxel);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((axes >> axis & 1) != 0 && at[axis] + 1 >= extent.size[axis]) return false;
    }
    return true;
}

template <class T>
class Values {
public:
    Values(std::span<const T> samples, const Extent& extent, double tunnel_height, SaddleValues saddles)
        : samples_(samples), extent_(extent), steps_(extent), tunnel_height_(tunnel_height), saddles_(saddles) {}

    [[nodiscard]] double of(ElementCode code) const {
        if (code.is_body()) return of_body(code);
        if (code.kind() == CodeKind::face) return of_face(code);
        return has_next(extent_, code.index(), 0) ? static_cast<double>(at(code.index())) : kNone;
    }

private:
    [[nodiscard]] T at(std::int64_t voxel) const { return samples_[static_cast<std::size_t>(voxel)]; }

    [[nodiscard]] double of_face(ElementCode code) const {
        const FaceAxes axes = kFaceAxes[code.index() % 3];
        if (!has_next(extent_, code.index() / 3, 1U << axes.axis1 | 1U << axes.axis2)) return kNone;
        std::array<T, 4> corner;
        for (int i = 0; i < 4; ++i) corner[i] = at(steps_.face_voxel(code.index(), i));
        const Diagonal highs = high_diagonal(corner[0], corner[1], corner[2], corner[3]);
        if (highs != (code.bd_high() ? Diagonal::bd : Diagonal::ac)) return kNone;
        if (saddles_ == SaddleValues::earlier) {
            return earlier_face_value(static_cast<double>(corner[0]), static_cast<double>(corner[1]), static_cast<double>(corner[2]),
                                      static_cast<double>(corner[3]), highs);
        }
        return disambiguation_value(corner[0], corner[1], corner[2], corner[3], highs);
    }

    [[nodiscard]] double of_body(ElementCode code) const {
        if (!has_next(extent_, code.cell(), 0b111)) return kNone;
        CellElements cell;
        for (int k = 0; k < 8; ++k) {
            cell.voxel[k] = steps_.cell_corner(code.cell(), k);
            cell.value[k] = static_cast<double>(at(cell.voxel[k]));
        }
        const CellBodies bodies = bodies_of(cell);
        const std::optional<BodyPoint>& body = code.kind() == CodeKind::body_open ? bodies.opening : bodies.closing;
        return body ? body->value : kNone;
    }

    [[nodiscard]] CellBodies bodies_of(CellElements& cell) const {
        if (saddles_ == SaddleValues::earlier) return earlier_bodies(cell, tunnel_height_);
        find_ambiguous_faces(cell);
        return bodies_of_cell(cell, default_face_types(cell), tunnel_height_);
    }

    std::span<const T> samples_;
    const Extent& extent_;
    GridSteps steps_;
    double tunnel_height_;
    SaddleValues saddles_;
};

}  // namespace

void find_element_values(std::span<const std::uint64_t> codes, const VolumeView& volume, double tunnel_height, int threads,
                         std::span<double> values, SaddleValues saddles) {
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const Values<T> of_elements(samples, volume.info->extent, tunnel_height, saddles);
        for_each_index(threads, codes.size(),
                       [&](std::size_t i) { values[i] = of_elements.of(ElementCode{codes[i]}) + 0.0; });  // as the scan: no -0.0
    });
}

}  // namespace isoatlas
