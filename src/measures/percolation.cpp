// The isovalues at which a phase connects both end faces of a volume (docs/measures.md#percolation).
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cancel.h"
#include "base/id_array.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "isoatlas/environment.h"
#include "isoatlas/measures.h"

namespace isoatlas {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

/// The voxels of one end face of an axis.
template <class Visit>
void for_face(const Extent& extent, std::size_t axis, bool at_end, const Visit& visit) {
    Index3 begin{0, 0, 0}, end = extent.size;
    at_end ? begin[axis] = extent.size[axis] - 1 : end[axis] = 1;
    for (std::int64_t z = begin[2]; z < end[2]; ++z) {
        for (std::int64_t y = begin[1]; y < end[1]; ++y) {
            for (std::int64_t x = begin[0]; x < end[0]; ++x) visit(VoxelId(extent.index(x, y, z)));
        }
    }
}

struct EventLink {
    double value;
    EventId parent;
};
using Links = IdArray<EventId, EventLink>;

/// From which isovalue of its zone on the object of each event holds a sample of a face; kNever: it does not.
IdArray<EventId, double> reaching(const Volume& volume, const Analysis& analysis, const Links& links, std::size_t axis, bool at_end) {
    IdArray<EventId, double> from(links.size(), kNever);
    for_face(volume.info.extent, axis, at_end, [&](VoxelId voxel) {
        double& highest = from[analysis.zone(voxel)];
        highest = std::max(highest, volume.value(voxel.number()));
    });
    for (const EventId event : streamed<EventId>(links.size(), at_random())) {  // children before their parent
        const EventId parent = links[event].parent;
        if (from[event] != kNever && parent.exists()) from[parent] = links[parent].value;
    }
    return from;
}

/// The samples in reversed order, exactly: integers as lowest + highest - v, which their type holds; reals as -v.
struct ReversedSamples {
    Volume volume;
    double both = 0;  ///< lowest + highest; reals: 0

    /// The value whose reversed one this is.
    [[nodiscard]] double back(double value) const { return both - value; }
};

ReversedSamples reversed_samples(const Volume& volume, const Context& context) {
    ReversedSamples result;
    result.volume.info = volume.info;
    result.volume.bytes.resize(volume.bytes.size());
    visit_type(volume.info.type, [&]<class T>(T) {
        const std::span<const T> from = volume.samples<T>();
        const std::span<T> to = result.volume.samples<T>();
        if constexpr (std::is_floating_point_v<T>) {
            for_each_index(context.threads, from.size(), [&](std::size_t i) { to[i] = -from[i]; });
        } else {
            const auto [low, high] = std::ranges::minmax(from);
            const std::int64_t both = std::int64_t{low} + std::int64_t{high};
            for_each_index(context.threads, from.size(), [&](std::size_t i) { to[i] = static_cast<T>(both - std::int64_t{from[i]}); });
            result.both = static_cast<double>(both);
        }
    });
    return result;
}

}  // namespace

Vec3 high_percolation(const Volume& volume, const Analysis& analysis, const Context& context) {
    const EnvironmentScope scope(context);
    if (analysis.extent() != volume.info.extent) throw Error(ErrorKind::usage, {.what = "the analysis is of another volume"});
    const auto count = static_cast<std::size_t>(analysis.event_count());
    Links links(count);
    for (const EventId event : streamed<EventId>(count, at_random())) {
        const Event each = analysis.event(event);
        links[event] = {each.value, each.parent};
    }
    Vec3 result{kNever, kNever, kNever};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        stop_if_cancelled(context);
        const IdArray<EventId, double> first = reaching(volume, analysis, links, axis, false);
        const IdArray<EventId, double> last = reaching(volume, analysis, links, axis, true);
        for (const EventId event : streamed<EventId>(count, in_order(2)))
            result[axis] = std::max(result[axis], std::min(first[event], last[event]));
    }
    return result;
}

Percolation percolation(const Volume& volume, const AnalysisOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    AnalysisOptions zoned = options;
    zoned.zones = true;
    Percolation result;
    result.high = high_percolation(volume, analyse(volume, zoned, context), context);
    const ReversedSamples other = reversed_samples(volume, context);
    result.low = high_percolation(other.volume, analyse(other.volume, zoned, context), context);
    for (double& tau : result.low) tau = other.back(tau);
    return result;
}

}  // namespace isoatlas
