#include "zones/label.h"

#include <atomic>

#include "critical/basins.h"

namespace isoatlas {
namespace {

template <class Id>
void add(std::span<Id> counts, Id zone, Id count) {
    std::atomic_ref<Id>(counts[zone]).fetch_add(count, std::memory_order_relaxed);
}

}  // namespace

template <class T, class Id>
void label_zones(std::span<const T> samples, const HeavyPaths<Id>& paths, std::span<const typename HeavyPaths<Id>::Place> start,
                 std::span<Id> basin_to_zone, std::span<Id> counts) {
    Id basin = 0, zone = 0, run = 0;
    T value{};
    for (std::size_t v = 0; v < samples.size(); ++v) {
        const Id next_basin = Basins<Id>::number(basin_to_zone[v]);
        if (run == 0 || next_basin != basin || samples[v] != value) {  // runs of one value in one basin share the climb
            basin = next_basin;
            value = samples[v];
            const Id next_zone = paths.zone(start[basin], static_cast<double>(value));
            if (run > 0 && next_zone != zone) {
                add(counts, zone, run);
                run = 0;
            }
            zone = next_zone;
        }
        basin_to_zone[v] = zone;
        ++run;
    }
    if (run > 0) add(counts, zone, run);
}

#define ISOATLAS_LABEL(T)                                                                                                            \
    template void label_zones(std::span<const T>, const HeavyPaths<std::uint32_t>&, std::span<const HeavyPaths<std::uint32_t>::Place>, \
                              std::span<std::uint32_t>, std::span<std::uint32_t>);                                                    \
    template void label_zones(std::span<const T>, const HeavyPaths<std::uint64_t>&, std::span<const HeavyPaths<std::uint64_t>::Place>, \
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

}  // namespace isoatlas
