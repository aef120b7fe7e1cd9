#include "bricks/brick_histogram.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "base/sample_types.h"

namespace isoatlas {
namespace {

/// Bin of a value: 0 before the first edge, edges.size() after the last.
std::size_t part_of(std::span<const double> edges, double value) {
    if (value == edges.back()) return edges.size() - 1;
    return static_cast<std::size_t>(std::ranges::upper_bound(edges, value) - edges.begin());
}

/// The same for samples: by lookup table for small integer types.
template <class T>
class PartOf {
public:
    explicit PartOf(std::span<const double> edges) : edges_(edges) {
        if constexpr (kFew) {
            for (int value = Limits::min(); value <= Limits::max(); ++value)
                of_.push_back(static_cast<std::uint32_t>(part_of(edges, value)));
        }
    }
    std::size_t operator()(T sample) const {
        if constexpr (kFew) return of_[static_cast<std::size_t>(sample - Limits::min())];
        return part_of(edges_, static_cast<double>(sample));
    }

private:
    using Limits = std::numeric_limits<T>;
    static constexpr bool kFew = Limits::is_integer && sizeof(T) <= 2;

    std::span<const double> edges_;
    std::vector<std::uint32_t> of_;
};

}  // namespace

template <class T>
std::vector<std::int64_t> brick_histogram(const BrickReader<T>& bricks, std::span<const double> edges, const Context& context,
                                          IoCounters& counters) {
    std::vector<std::int64_t> counts(edges.size() + 1);
    std::vector<BrickId> wanted;
    for (const BrickId b : bricks.grid().bricks()) {
        const std::size_t part = part_of(edges, static_cast<double>(bricks.low(b)));
        if (part == part_of(edges, static_cast<double>(bricks.high(b))))
            counts[part] += bricks.grid().box(b).count();
        else
            wanted.push_back(b);
    }
    const PartOf<T> part(edges);
    std::mutex mutex;
    counters += bricks.read(std::move(wanted), context, [&](BrickId, std::span<const T> samples) {
        std::vector<std::int64_t> own(counts.size());
        for (const T sample : samples) ++own[part(sample)];
        const std::lock_guard lock(mutex);
        for (std::size_t i = 0; i < own.size(); ++i) counts[i] += own[i];
    });
    return {counts.begin() + 1, counts.end() - 1};
}

#define ISOATLAS_INSTANTIATE(T) \
    template std::vector<std::int64_t> brick_histogram<T>(const BrickReader<T>&, std::span<const double>, const Context&, IoCounters&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
