// Exact pairs of tunnels where that is cheap.
#include "isoatlas/environment.h"
#include "isoatlas/handles.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBytes = std::int64_t{1} << 26;   // of samples
constexpr std::int64_t kEvents = std::int64_t{1} << 20;  // beyond, only approximate pairs
constexpr std::size_t kTunnels = std::size_t{1} << 17;

}  // namespace

FoundHandles find_handles(const VolumeInfo& info, const Analysis& analysis, double min_persistence, const std::function<Volume()>& samples,
                          const Context& context) {
    const EnvironmentScope scope(context);
    const bool is_small =
        info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type)) <= kBytes && analysis.event_count() <= kEvents;
    if (!is_small || pair_handles(analysis).size() > kTunnels) return {pair_handles(analysis, min_persistence), false};
    return {pair_handles_exactly(samples(), analysis, {.min_persistence = min_persistence}, context), true};
}

}  // namespace isoatlas
