#include "atlas/event_arrays.h"

#include <algorithm>
#include <type_traits>

#include "analysis/analysis_data.h"
#include "base/big_vector.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxElements = std::int64_t{1} << 22;
constexpr std::int64_t kVoxelsAnElement = 3;

/// Calls visit(name, numbers) for every array.
template <class Id, class Visit>
void for_arrays(const AnalysisArrays<Id>& arrays, Visit&& visit) {
    using Signed = std::make_signed_t<Id>;
    visit("events/element", numbers_of<ElementIdOf<Id>>(arrays.tree.top.items()));
    visit("events/parent", numbers_of<EventIdOf<Id>>(arrays.tree.parent.items()));
    static_assert(sizeof(Criticality) == 1);
    const BigVector<Criticality>& kind = arrays.measures.kind.items();
    visit("events/kind", std::span(reinterpret_cast<const std::uint8_t*>(kind.data()), kind.size()));
    visit("events/lows_out", std::span<const Id>(arrays.measures.lows_out.items()));
    visit("events/delta_chi", std::span<const Signed>(arrays.measures.delta_chi.items()));
    visit("events/chi", std::span<const Signed>(arrays.measures.chi.items()));
    visit("events/contours", std::span<const Id>(arrays.measures.contours.items()));
    visit("events/voxels", std::span<const Id>(arrays.voxels.items()));
}

/// First difference between stored and expected numbers; "": none.
template <class N>
std::string difference(const Container& store, const char* name, const std::string& type, std::span<const N> expected) {
    const auto stored = store.all<N>(name, type);
    const auto [own, other] = std::mismatch(stored.begin(), stored.end(), expected.begin(), expected.end());
    if (own == stored.end() && other == expected.end()) return "";
    const std::string where = std::string(name) + "[" + std::to_string(own - stored.begin()) + "] ";
    if (own == stored.end()) return where + "is missing";
    if (other == expected.end()) return where + "is not an event";
    return where + "is " + std::to_string(*own) + ", the elements give " + std::to_string(*other);
}

template <class N>
std::string type_of() {
    return (std::is_signed_v<N> ? "int" : "uint") + std::to_string(8 * sizeof(N));
}

}  // namespace

bool stores_events(const Analysis& analysis) {
    const std::int64_t elements = analysis.element_count();
    return elements <= kMaxElements && elements <= analysis.extent().voxels() / kVoxelsAnElement;
}

std::vector<PackedArray> event_arrays(const Analysis& analysis) {
    std::vector<PackedArray> packs;
    analysis.data().visit([&](const auto& held) {
        for_arrays(held.arrays, [&]<class N>(const char* name, std::span<const N> numbers) {
            packs.push_back(packed_chunks<N>(name, type_of<N>(), numbers));
        });
    });
    return packs;
}

PackedArray event_sum_array(std::span<const double> sums) { return packed_chunks<double>("events/sum", "float64", sums); }

bool has_event_sums(const Container& store) { return store.contents().has_array("events/sum"); }

std::vector<double> event_sums_of(const Container& store, std::int64_t events) {
    if (!has_event_sums(store)) return {};
    const auto numbers = store.all<double>("events/sum", "float64");
    if (static_cast<std::int64_t>(numbers.size()) != events) {
        throw Error(ErrorKind::input, {.file = store.path(),
                                       .where = "events/sum",
                                       .what = "the number of sums differs from that of events",
                                       .next = "the store is damaged: build it again from the volume"});
    }
    return {numbers.begin(), numbers.end()};
}

std::string first_wrong_event(const Container& store, const Analysis& analysis) {
    std::string wrong;
    analysis.data().visit([&](const auto& held) {
        for_arrays(held.arrays, [&]<class N>(const char* name, std::span<const N> numbers) {
            if (wrong.empty()) wrong = difference<N>(store, name, type_of<N>(), numbers);
        });
    });
    return wrong;
}

}  // namespace isoatlas
