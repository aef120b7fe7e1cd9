// Locator: objects and cavities containing a sample, at any isovalue, from the trees. No surface is made.
#pragma once

#include <cstdint>
#include <optional>

#include "isoatlas/atlas.h"

namespace isoatlas {

/// Of one sample.
class Locator {
public:
    /// The atlas must live as long as this. Throws Error: usage (no such voxel), input (damaged). Cost: reads the bricks on a path from the
    /// sample that ascends to a maximum, and on one that descends to a minimum; the first call of an atlas reads the trees.
    Locator(const Atlas& atlas, std::int64_t voxel, const Context& context = {});

    /// Stored value of the sample.
    [[nodiscard]] double value() const { return value_; }
    /// The object that contains it, by its highest voxel, as in cut(); empty: it is Low at tau. Cost: that of ActiveIndex::object_of().
    [[nodiscard]] std::optional<std::int64_t> object(double tau) const;
    /// The cavity that contains it, by its lowest voxel, as in cut(); empty: it is High at tau, or outside of all objects. Cost: the same.
    [[nodiscard]] std::optional<std::int64_t> cavity(double tau) const;

private:
    const Atlas* atlas_;
    double value_ = 0;
    VoxelValue maximum_;
    std::optional<VoxelValue> minimum_;  ///< nothing: the path downwards leaves the volume
};

}  // namespace isoatlas
