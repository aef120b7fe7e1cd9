#include "zones/label.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "base/memory_limit.h"
#include "base/sample_types.h"
#include "base/streamed.h"
#include "critical/basins.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBlock = 256;  // samples whose zones are found together: what they use stays in the first-level cache
constexpr std::size_t kLimitedBlock = std::size_t{1} << 15;  // where memory is limited: more samples share a page of the tree

std::size_t block_size() { return memory_is_limited() ? kLimitedBlock : kBlock; }

/// Voxels per event. Few events are counted per thread and added once: threads would contend for their cache lines.
template <class Number>
class Tally {
public:
    explicit Tally(std::span<Number> counts) : shared_(counts), own_(counts.size() <= kFew ? counts.size() : 0, Number{0}) {}

    void add(std::span<const Number> zones) {
        if (!own_.empty()) {
            for (const Number zone : zones) ++own_[zone];
            return;
        }
        if (memory_is_limited()) {  // page after page
            sorted_.assign(zones.begin(), zones.end());
            std::ranges::sort(sorted_);
            zones = sorted_;
        }
        for_runs(zones, at_random(), [&](std::size_t first, std::size_t end) {
            if (end + kAhead < zones.size()) __builtin_prefetch(shared_.data() + zones[end + kAhead], 1);
            add(zones[first], static_cast<Number>(end - first));
        });
    }
    void finish() {
        for (std::size_t zone = 0; zone < own_.size(); ++zone) {
            if (own_[zone] > 0) add(zone, own_[zone]);
        }
    }

private:
    static constexpr std::size_t kFew = 1 << 16, kAhead = 16;

    void add(std::size_t zone, Number count) { std::atomic_ref<Number>(shared_[zone]).fetch_add(count, std::memory_order_relaxed); }

    std::span<Number> shared_;
    std::vector<Number> own_, sorted_;
};

}  // namespace

template <class T, class Number>
void label_zones(std::span<const T> samples, const HeavyPathDecomposition<Number, ComparisonValue<T>>& paths,
                 std::span<Number> basin_to_zone, std::span<Number> counts) {
    using Value = ComparisonValue<T>;
    Tally<Number> tally(counts);
    const std::size_t together = block_size();
    std::vector<Value> value(together);
    std::vector<Number> maximum(together);
    std::vector<std::uint32_t> scratch(together);
    const std::size_t blocks = (samples.size() + together - 1) / together;
    for (const std::size_t block : streamed(blocks, {together * (sizeof(T) + 2 * sizeof(Number))})) {
        const std::size_t first = block * together, count = std::min(together, samples.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            value[i] = static_cast<Value>(samples[first + i]);
            maximum[i] = Basins<Number>::number(basin_to_zone[first + i]);
        }
        const std::span<Number> zones = basin_to_zone.subspan(first, count);
        paths.zones({value.data(), count}, {maximum.data(), count}, scratch, zones);
        tally.add(zones);
    }
    tally.finish();
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define ISOATLAS_LABEL(T)                                                                                                             \
    template void label_zones<T, std::uint32_t>(std::span<const T>, const HeavyPathDecomposition<std::uint32_t, ComparisonValue<T>>&, \
                                                std::span<std::uint32_t>, std::span<std::uint32_t>);                                  \
    template void label_zones<T, std::uint64_t>(std::span<const T>, const HeavyPathDecomposition<std::uint64_t, ComparisonValue<T>>&, \
                                                std::span<std::uint64_t>, std::span<std::uint64_t>);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_LABEL)
#undef ISOATLAS_LABEL
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
