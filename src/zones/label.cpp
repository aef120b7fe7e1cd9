#include "zones/label.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "critical/basins.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBlock = 1024;  // samples that climb together

template <class Id>
void add(std::span<Id> counts, Id zone, Id count) {
    std::atomic_ref<Id>(counts[zone]).fetch_add(count, std::memory_order_relaxed);
}

}  // namespace

template <class T, class Id>
void label_zones(std::span<const T> samples, const HeavyPaths<Id, ComparisonValue<T>>& paths, std::span<Id> basin_to_zone,
                 std::span<Id> counts) {
    using Value = ComparisonValue<T>;
    std::vector<Value> value(kBlock);
    std::vector<Id> maximum(kBlock);
    std::vector<std::uint32_t> scratch(kBlock);
    Id zone = 0, run = 0;
    for (std::size_t first = 0; first < samples.size(); first += kBlock) {
        const std::size_t count = std::min(kBlock, samples.size() - first);
        const std::span<Id> block = basin_to_zone.subspan(first, count);
        for (std::size_t i = 0; i < count; ++i) {
            value[i] = static_cast<Value>(samples[first + i]);
            maximum[i] = Basins<Id>::number(block[i]);
        }
        paths.zones({value.data(), count}, {maximum.data(), count}, scratch, block);
        for (const Id next : block) {
            if (next != zone) {
                if (run > 0) add(counts, zone, run);
                zone = next;
                run = 0;
            }
            ++run;
        }
    }
    if (run > 0) add(counts, zone, run);
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define ISOATLAS_LABEL(T)                                                                                                 \
    template void label_zones<T, std::uint32_t>(std::span<const T>, const HeavyPaths<std::uint32_t, ComparisonValue<T>>&, \
                                                std::span<std::uint32_t>, std::span<std::uint32_t>);                      \
    template void label_zones<T, std::uint64_t>(std::span<const T>, const HeavyPaths<std::uint64_t, ComparisonValue<T>>&, \
                                                std::span<std::uint64_t>, std::span<std::uint64_t>);
ISOATLAS_LABEL(std::uint8_t)
ISOATLAS_LABEL(std::int8_t)
ISOATLAS_LABEL(std::uint16_t)
ISOATLAS_LABEL(std::int16_t)
ISOATLAS_LABEL(std::uint32_t)
ISOATLAS_LABEL(std::int32_t)
ISOATLAS_LABEL(float)
ISOATLAS_LABEL(double)
#undef ISOATLAS_LABEL
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
