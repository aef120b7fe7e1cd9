#include "store/tree_arrays.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "field/order.h"
#include "isoatlas/error.h"
#include "zones/analysis_data.h"
#include "zones/trees.h"

namespace isoatlas::store {
namespace {

template <class N>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<N, double>) return "float64";
    if constexpr (std::is_same_v<N, std::uint8_t>) return "uint8";
    if constexpr (std::is_same_v<N, std::uint32_t>) return "uint32";
    if constexpr (std::is_same_v<N, std::int32_t>) return "int32";
    if constexpr (std::is_same_v<N, std::uint64_t>) return "uint64";
    return "int64";
}

/// Calls visit(name, array) for every array of an analysis that is stored, in the order of the file. All others follow from them.
template <class Arrays, class Visit>
void for_arrays(Arrays& a, Visit&& visit) {
    visit("elements/value", a.value);
    visit("elements/code", a.code);
    visit("elements/towards_outside", a.contours.other);
}
constexpr const char* kVoxels = "elements/voxels";

[[noreturn]] void contradiction(const Container& store, const char* what) {
    throw Error(ErrorKind::input,
                {.file = store.path(), .where = "trees", .what = what, .next = "the store is damaged: build it again from the volume"});
}

/// What the trees are made of without looking: values in order, codes of elements of this grid.
template <class Id>
void check(const AnalysisArrays<Id>& a, const Extent& extent, const Container& store) {
    const std::size_t n = a.value.size();
    if (n == 0) contradiction(store, "there are no critical elements");
    if (a.code.size() != n) contradiction(store, "arrays of the same things have different lengths");
    for (std::size_t i = 0; i < n; ++i) {
        if (!(i == 0 || a.value[i] <= a.value[i - 1]) || std::isnan(a.value[i])) contradiction(store, "values do not descend");
        const ElementCode code{a.code[i]};
        const std::int64_t owner = code.is_body() ? code.cell() : code.kind() == CodeKind::face ? code.index() / 3 : code.index();
        if (code.h0() > 2 || code.l0() > 2 || owner >= extent.voxels()) contradiction(store, "a critical element does not exist");
    }
}

template <class N>
void read_array(const Container& store, const char* name, BigVector<N>& numbers) {
    const StoredArray& array = store.contents().array(name, type_name<N>());
    numbers.resize(static_cast<std::size_t>(array.count()));
    store.read(array, 0, std::as_writable_bytes(std::span<N>(numbers)));
}

template <class Id>
std::unique_ptr<IndexedArrays<Id>> read_arcs(const Container& store) {
    auto result = std::make_unique<IndexedArrays<Id>>();
    AnalysisArrays<Id>& arrays = result->arrays;
    for_arrays(arrays, [&](const char* name, auto& numbers) { read_array(store, name, numbers); });
    check(arrays, store.contents().volume.extent, store);
    return result;
}

}  // namespace

std::vector<PackedArray> tree_arrays(const Analysis& analysis) {
    std::vector<PackedArray> packs;
    analysis.data().visit([&](const auto& held) {
        for_arrays(held.arrays, [&]<class N>(const char* name, const BigVector<N>& numbers) {
            packs.push_back(packed_chunks<N>(name, type_name<N>(), std::span<const N>(numbers)));
        });
    });
    return packs;
}

std::vector<PackedArray> zone_arrays(const Analysis& analysis) {
    return analysis.data().visit([]<class Id>(const IndexedArrays<Id>& held) -> std::vector<PackedArray> {
        return {packed_chunks<Id>(kVoxels, type_name<Id>(), std::span<const Id>(held.arrays.element_voxels))};
    });
}

std::vector<PackedArray> copied_arrays(const Container& store) {
    std::vector<PackedArray> packs;
    for (const StoredArray& array : store.contents().arrays) {
        packs.push_back({array.name, array.type, array.shape, array.block, [&store, &array](const Put& put) {
                             std::vector<std::byte> part;
                             for (std::int64_t first = 0; first < array.bytes(); first += array.block) {
                                 part.resize(static_cast<std::size_t>(std::min(array.block, array.bytes() - first)));
                                 store.read(array, first, part);
                                 put(part);
                             }
                         }});
        if (array.chunk == 0) continue;
        packs.back().chunk = array.chunk;
        packs.back().feed_chunks = [&store, &array](const Put& put) { store.for_each_chunk(array, put); };
    }
    return packs;
}

Analysis arcs_of(const Container& store) {
    const Contents& contents = store.contents();
    auto data = std::make_unique<Analysis::Data>();
    data->extent = contents.volume.extent;
    data->interpolant = contents.parameters.interpolant;
    data->tunnel_height = contents.parameters.tunnel_height;
    const bool is_wide = std::any_of(contents.arrays.begin(), contents.arrays.end(),
                                     [](const StoredArray& a) { return a.name == "elements/towards_outside" && a.type == "uint64"; });
    if (is_wide) {
        data->arrays = read_arcs<std::uint64_t>(store);
    } else {
        data->arrays = read_arcs<std::uint32_t>(store);
    }
    return Analysis(std::move(data));
}

Analysis analysis_of(const Container& store, int threads) {
    Analysis analysis = arcs_of(store);
    analysis.data().visit([&]<class Id>(IndexedArrays<Id>& held) {
        AnalysisArrays<Id>& arrays = held.arrays;
        if (!restore_trees(arrays, store.contents().volume.extent.rank, threads)) contradiction(store, "the contour tree is none");
        read_array(store, kVoxels, arrays.element_voxels);
        if (arrays.element_voxels.size() != arrays.value.size()) contradiction(store, "not every element has its number of voxels");
        add_up_voxels(arrays);
        release(arrays.element_voxels);
    });
    return analysis;
}

}  // namespace isoatlas::store
