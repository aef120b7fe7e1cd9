#include "store/tree_arrays.h"

#include <algorithm>
#include <type_traits>

#include "isoatlas/error.h"
#include "zones/analysis_data.h"

namespace isoatlas::store {
namespace {

template <class N>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<N, double>) return "float64";
    if constexpr (std::is_same_v<N, std::uint8_t> || std::is_enum_v<N>) return "uint8";
    if constexpr (std::is_same_v<N, std::uint32_t>) return "uint32";
    if constexpr (std::is_same_v<N, std::int32_t>) return "int32";
    if constexpr (std::is_same_v<N, std::uint64_t>) return "uint64";
    return "int64";
}

/// Calls visit(name, array) for every array of an analysis, in the order of the file.
template <class Arrays, class Visit>
void for_arrays(Arrays& a, Visit&& visit) {
    visit("elements/value", a.value);
    visit("elements/code", a.code);
    visit("elements/level", a.level);
    visit("contours/other", a.contours.other);
    visit("contours/half_chi", a.contours.half_chi);
    visit("contours/degree", a.contours.degree);
    visit("events/of_element", a.tree.event_of_element);
    visit("events/top", a.tree.top);
    visit("events/parent", a.tree.parent);
    visit("events/kind", a.measures.kind);
    visit("events/lows_out", a.measures.lows_out);
    visit("events/contours", a.measures.contours);
    visit("events/delta_chi", a.measures.delta_chi);
    visit("events/chi", a.measures.chi);
    visit("events/voxels", a.voxels);
}

[[noreturn]] void contradiction(const Container& store, const char* what) {
    throw Error(ErrorKind::input,
                {.file = store.path(), .where = "trees", .what = what, .next = "the store is damaged: build it again from the volume"});
}

template <class Id>
bool all_below(const BigVector<Id>& ids, std::size_t limit) {
    return std::all_of(ids.begin(), ids.end(), [limit](Id id) { return id < limit; });
}

/// Every id names something: what follows indexes without looking.
template <class Id>
void check(const AnalysisArrays<Id>& a, const Container& store) {
    const std::size_t n = a.value.size(), events = a.tree.top.size();
    if (n == 0 || events == 0) contradiction(store, "there are none");
    const bool sizes = a.code.size() == n && a.level.size() == n && a.contours.other.size() == n + 1 &&
                       a.contours.half_chi.size() == n + 1 && a.contours.degree.size() == n + 1 && a.tree.event_of_element.size() == n &&
                       a.tree.parent.size() == events && a.measures.kind.size() == events && a.measures.lows_out.size() == events &&
                       a.measures.contours.size() == events && a.measures.delta_chi.size() == events && a.measures.chi.size() == events &&
                       a.voxels.size() == events;
    if (!sizes) contradiction(store, "arrays of the same things have different lengths");
    bool ids = all_below(a.level, n) && all_below(a.contours.other, n + 1) && all_below(a.tree.event_of_element, events) &&
               all_below(a.tree.top, n) && all_below(a.tree.parent, events) && a.tree.parent[events - 1] == events - 1;
    for (std::size_t e = 0; e + 1 < events; ++e) ids = ids && a.tree.parent[e] > e;
    for (const Criticality kind : a.measures.kind) ids = ids && kind <= Criticality::complex;
    if (!ids) contradiction(store, "an id is out of range");
}

template <class Id>
std::unique_ptr<IndexedArrays<Id>> read_arrays(const Container& store) {
    auto result = std::make_unique<IndexedArrays<Id>>();
    for_arrays(result->arrays, [&]<class N>(const char* name, BigVector<N>& numbers) {
        const StoredArray& array = store.contents().array(name, type_name<N>());
        numbers.resize(static_cast<std::size_t>(array.count()));
        store.read(array, 0, std::as_writable_bytes(std::span<N>(numbers)));
    });
    check(result->arrays, store);
    return result;
}

}  // namespace

std::vector<PackedArray> tree_arrays(const Analysis& analysis) {
    std::vector<PackedArray> packs;
    analysis.data().visit([&](const auto& held) {
        for_arrays(held.arrays, [&]<class N>(const char* name, const BigVector<N>& numbers) {
            packs.push_back(packed<N>(name, type_name<N>(), std::span<const N>(numbers)));
        });
    });
    return packs;
}

Analysis analysis_of(const Container& store) {
    const Contents& contents = store.contents();
    auto data = std::make_unique<Analysis::Data>();
    data->extent = contents.volume.extent;
    data->interpolant = contents.parameters.interpolant;
    data->tunnel_height = contents.parameters.tunnel_height;
    const bool is_wide = std::any_of(contents.arrays.begin(), contents.arrays.end(),
                                     [](const StoredArray& a) { return a.name == "elements/level" && a.type == "uint64"; });
    if (is_wide) {
        data->arrays = read_arrays<std::uint64_t>(store);
    } else {
        data->arrays = read_arrays<std::uint32_t>(store);
    }
    return Analysis(std::move(data));
}

}  // namespace isoatlas::store
