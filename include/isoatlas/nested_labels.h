// Label volumes of objects and cavities, each at an isovalue of its own: of nested ones a voxel has the label of the innermost.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "isoatlas/cut.h"

namespace isoatlas {

/// An object, or a cavity, with its label.
struct NestedPart {
    bool is_cavity = false;
    std::int64_t voxel = 0;   ///< in the object or cavity at tau
    double tau = 0;           ///< stored
    std::uint32_t label = 0;  ///< not 0
};

/// What is at an isovalue, for all voxels.
struct NestedSource {
    /// Cut::label, as cut() fills it.
    std::function<std::vector<std::int32_t>(double tau)> objects;
    /// The cavity of each voxel from 1, 0: none, as label_cavities() finds it; may be empty where no part is a cavity.
    std::function<std::vector<std::uint32_t>(double tau)> cavities;
};

/// Labels per voxel, 0: in no part. Objects at two isovalues are nested or apart, so the innermost one is that of the highest isovalue; an
/// object that is given twice has its first label. Cavities lie inside objects: their labels hide those of objects, the cavity of the
/// lowest isovalue first. Throws Error: usage (a voxel or label out of range), not_found (where: the position of the part; its voxel is in
/// no object or cavity at its isovalue), and what the source throws. Cost: one call of the source for each isovalue, and a pass over its
/// voxels.
[[nodiscard]] std::vector<std::uint32_t> nested_labels(std::int64_t voxels, std::span<const NestedPart> parts, const NestedSource& source);

/// Adds labels of other objects, which may overlap those that are there: objects of low values. A voxel that both hold gets the label that
/// fewer voxels have, each counted where it was given; of equal ones that which was there. No label is in both. Cost: two passes.
void overlay_labels(std::vector<std::uint32_t>& labels, std::span<const std::uint32_t> more);

}  // namespace isoatlas
