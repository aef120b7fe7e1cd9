// The engine asks of its domain only what critical/domain.h says: it analyses a path graph as it does a grid.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "analysis/analyse_domain.h"
#include "field/order.h"

namespace isoatlas {
namespace {

/// A path of vertices with different values, in a space that is Low: objects are runs of vertices, and merge at the minima between them.
struct PathDomain {
    using Number = std::uint32_t;
    using Sample = double;
    std::vector<double> value;

    [[nodiscard]] bool is_above(std::size_t v, std::ptrdiff_t step) const {
        const auto other = static_cast<std::ptrdiff_t>(v) + step;
        return other >= 0 && other < std::ssize(value) && value[other] > value[v];
    }
    [[nodiscard]] int objects_above(std::size_t v) const { return int{is_above(v, -1)} + int{is_above(v, 1)}; }
    [[nodiscard]] std::size_t maximum_of(std::size_t v) const {
        while (objects_above(v) > 0) v += is_above(v, 1) ? 1 : -1;
        return v;
    }
    [[nodiscard]] Number number_of(std::size_t maximum) const {
        Number number = 0;
        for (std::size_t v = 0; v < maximum; ++v) number += objects_above(v) == 0 ? 1 : 0;
        return number;
    }
    [[nodiscard]] Criticals<Number> critical(bool /*keep_basins*/, const Context& /*context*/) const {
        using Maximum = MaximumIdOf<Number>;
        const MinimumIdOf<Number> outside(0);
        Criticals<Number> result;
        std::vector<std::size_t> order(value.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::sort(order, std::greater<>(), [this](std::size_t v) { return value[v]; });
        for (const std::size_t v : order) {
            const int above = objects_above(v);
            result.set.maxima += above == 0 ? 1 : 0;
            if (above == 1) continue;
            result.set.value.push_back(value[v]);
            result.set.code.push_back(ElementCode::vertex(static_cast<std::int64_t>(v), above, 1, 0).bits);
            result.set.up_a.push_back(Maximum(number_of(maximum_of(above == 2 ? v - 1 : v))));
            result.set.up_b.push_back(Maximum(number_of(maximum_of(above == 2 ? v + 1 : v))));
            result.set.low_a.push_back(outside), result.set.low_b.push_back(outside);
        }
        for (std::size_t v = 0; v < value.size(); ++v) result.basin.push_back(number_of(maximum_of(v)));
        return result;
    }
    [[nodiscard]] std::span<const double> samples() const { return value; }
    [[nodiscard]] ElementsOfMaxima<Number> elements_of_maxima(ByElementView<Number, std::uint64_t> code) const {
        ElementsOfMaxima<Number> elements(value.size());
        std::size_t maxima = 0;
        for (const ElementIdOf<Number> i : code.ids()) {
            const ElementCode element{code[i]};
            if (element.h0() == 0) elements[MaximumIdOf<Number>(number_of(element.index()))] = i, ++maxima;
        }
        elements.items().resize(maxima);
        return elements;
    }
    void for_parts(const Context&, const Phase&, const std::function<void(std::size_t, std::size_t)>& work) const { work(0, value.size()); }
};
static_assert(Domain<PathDomain>);

/// The lowest critical vertex in the run of vertices around v that are not below it: there the object of v became what it is.
std::size_t event_vertex(const PathDomain& path, std::size_t v) {
    std::size_t first = v, last = v;
    while (first > 0 && path.value[first - 1] >= path.value[v]) --first;
    while (last + 1 < path.value.size() && path.value[last + 1] >= path.value[v]) ++last;
    std::size_t lowest = path.maximum_of(v);
    for (std::size_t w = first; w <= last; ++w) {
        if (path.objects_above(w) != 1 && path.value[w] < path.value[lowest]) lowest = w;
    }
    return lowest;
}

RC_GTEST_PROP(ADomain, ThatIsAPathHasTheZonesOfItsRuns, ()) {
    PathDomain path{std::vector<double>(*rc::gen::inRange<std::size_t>(1, 40))};
    std::iota(path.value.begin(), path.value.end(), -3.0);
    std::ranges::shuffle(path.value, std::mt19937(*rc::gen::arbitrary<unsigned>()));
    AnalysisArrays<std::uint32_t> arrays;
    analyse_domain(path, true, arrays, {});
    RC_ASSERT(arrays.zone.size() == path.value.size());
    for (std::size_t v = 0; v < path.value.size(); ++v) {
        const auto top = arrays.tree.top[arrays.zone_of(VoxelId(v))];
        RC_ASSERT(static_cast<std::size_t>(ElementCode{arrays.code[top]}.index()) == event_vertex(path, v));
    }
    std::vector<std::uint32_t> counted(arrays.tree.size(), 0);
    for (const std::uint32_t zone : arrays.zone.items()) ++counted[zone];
    RC_ASSERT(std::ranges::equal(counted, arrays.voxels.items()));
}

}  // namespace
}  // namespace isoatlas
