// An ascending path stays in the object of its first sample at all isovalues up to the value of that sample; it ends at a maximum, which
// the trees contain. The same downwards; outside the volume is Low.
#include "isoatlas/locate.h"

#include "atlas/access.h"
#include "base/cancel.h"
#include "bricks/stored_samples.h"
#include "isoatlas/environment.h"
#include "levelset/level_bricks.h"

namespace isoatlas {
namespace {

class Paths {
public:
    Paths(const Atlas& atlas, const Context& context)
        : samples_(AtlasAccess::samples(atlas)), extent_(atlas.info().extent), context_(context) {}

    [[nodiscard]] Extremum at(std::int64_t voxel) { return {VoxelId(voxel), samples_.sample(voxel, spent_)}; }

    /// The highest neighbour above (below: the lowest one below); the voxel itself: none.
    [[nodiscard]] Extremum next(const Extremum& from, bool up) {
        stop_if_cancelled(context_);
        Extremum best = from;
        const Index3 at = extent_.voxel(from.voxel.number());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const std::int64_t by : {-1, 1}) {
                Index3 other = at;
                other[axis] += by;
                if (other[axis] < 0 || other[axis] >= extent_.size[axis]) continue;
                const Extremum neighbour = this->at(extent_.index(other));
                if (up ? neighbour.is_above(best) : best.is_above(neighbour)) best = neighbour;
            }
        }
        return best;
    }
    [[nodiscard]] bool is_at_border(std::int64_t voxel) const {
        const Index3 at = extent_.voxel(voxel);
        for (int axis = 0; axis < extent_.rank; ++axis) {
            if (at[axis] == 0 || at[axis] == extent_.size[axis] - 1) return true;
        }
        return false;
    }
    [[nodiscard]] const LevelQuery& spent() const { return spent_; }

private:
    StoredSamples& samples_;
    const Extent& extent_;
    const Context& context_;
    LevelQuery spent_;
};

}  // namespace

Locator::Locator(const Atlas& atlas, std::int64_t voxel, const Context& context) : atlas_(&atlas) {
    const EnvironmentScope scope(context);
    const Extent& extent = atlas.info().extent;
    if (voxel < 0 || voxel >= extent.voxels()) {
        throw Error(ErrorKind::usage, {.where = "voxel " + std::to_string(voxel),
                                       .what = "the volume has no such sample",
                                       .expected = "0 to " + std::to_string(extent.voxels() - 1)});
    }
    Paths paths(atlas, context);
    const Extremum start = paths.at(voxel);
    value_ = start.value;
    Extremum top = start;
    for (Extremum next = paths.next(top, true); next.voxel != top.voxel; next = paths.next(top, true)) top = next;
    maximum_ = {top.voxel.number(), top.value};
    Extremum bottom = start;
    while (!paths.is_at_border(bottom.voxel.number())) {
        const Extremum next = paths.next(bottom, false);
        if (next.voxel == bottom.voxel) {
            minimum_ = {bottom.voxel.number(), bottom.value};
            break;
        }
        bottom = next;
    }
    AtlasAccess::count(atlas, paths.spent(), 0, nullptr);
}

std::optional<std::int64_t> Locator::object(double tau) const {
    if (value_ < tau) return std::nullopt;
    return atlas_->active_index().object_of(maximum_, tau);
}

std::optional<std::int64_t> Locator::cavity(double tau) const {
    if (value_ >= tau || !minimum_) return std::nullopt;
    return atlas_->active_index().cavity_of(*minimum_, tau);
}

}  // namespace isoatlas
