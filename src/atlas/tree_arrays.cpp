#include "atlas/tree_arrays.h"

#include <algorithm>
#include <cmath>

#include "analysis/analysis_data.h"
#include "analysis/trees.h"
#include "atlas/element_arrays.h"
#include "store/pack.h"
#include "store/typed_arrays.h"

namespace isoatlas {
namespace {

constexpr const char* kTowardsOutside = "elements/towards_outside";
constexpr const char* kVoxels = "elements/voxels";

/// Checks the input of the trees: values in order.
template <class Id>
void check(const ArcArrays<Id>& a, const Container& store) {
    const std::size_t n = a.value.size();
    if (n == 0) contradiction(store, "there are no critical elements");
    if (a.code.size() != n) contradiction(store, "arrays of the same things have different lengths");
    const BigVector<double>& value = a.value.items();
    for (std::size_t i = 0; i < n; ++i) {
        if (!(i == 0 || value[i] <= value[i - 1]) || std::isnan(value[i])) contradiction(store, "values do not descend");
    }
}

template <class Id>
ArcArrays<Id> read_arcs(const Container& store, const std::byte* samples, const Context& context) {
    ArcArrays<Id> arrays;
    read_elements<Id>(store, samples, context, arrays.code.items(), arrays.value.items());
    read_array(store, kTowardsOutside, type_name<Id>(), arrays.contours.other.items());
    check(arrays, store);
    return arrays;
}

/// With voxel counts.
Analysis with_trees(const Container& store, const std::byte* samples, const Context& context) {
    ContourArcs arcs = arcs_of(store, samples, context);
    std::optional<Analysis> analysis = restored_trees(arcs, context);
    if (!analysis) contradiction(store, "the contour tree is not a tree");
    analysis->data().visit([&]<class Id>(IndexedArrays<Id>& held) {
        ByElement<Id, Id> voxels;
        read_array(store, kVoxels, type_name<Id>(), voxels.items());
        if (voxels.size() != held.arrays.value.size()) contradiction(store, "not every element has its number of voxels");
        add_up_voxels<Id>(voxels, held.arrays);
    });
    return std::move(*analysis);
}

}  // namespace

std::vector<PackedArray> tree_arrays(const ContourArcs& arcs, const VolumeInfo& volume, int threads) {
    return std::visit(
        [&]<class Id>(const ArcArrays<Id>& arrays) {
            std::vector<PackedArray> packs = element_arrays<Id>(arrays.value.items(), arrays.code.items(), volume, threads);
            packs.push_back(
                packed_chunks<Id>(kTowardsOutside, type_name<Id>(), numbers_of<ElementIdOf<Id>>(arrays.contours.other.items())));
            return packs;
        },
        arcs.arrays);
}

PackedArray voxel_array(const ElementVoxels& voxels) {
    return std::visit(
        []<class Id>(const ByElement<Id, Id>& held) {
            return packed_chunks<Id>(kVoxels, type_name<Id>(), std::span<const Id>(held.items()));
        },
        voxels);
}

std::vector<PackedArray> copied_arrays(const Container& store) {
    std::vector<PackedArray> packs;
    for (const StoredArray& array : store.contents().arrays) {
        packs.push_back({array.name, array.type, array.shape, array.block, [&store, &array](const ByteSink& put) {
                             std::vector<std::byte> part;
                             for (std::int64_t first = 0; first < array.bytes(); first += array.block) {
                                 part.resize(static_cast<std::size_t>(std::min(array.block, array.bytes() - first)));
                                 store.read(array, first, part);
                                 put(part);
                             }
                         }});
        if (array.chunk == 0) continue;
        packs.back().chunk = array.chunk;
        packs.back().feed_chunks = [&store, &array](const ByteSink& put) { store.for_each_chunk(array, put); };
    }
    return packs;
}

ContourArcs arcs_of(const Container& store, const std::byte* samples, const Context& context) {
    const Contents& contents = store.contents();
    ContourArcs arcs{contents.volume.extent, contents.parameters.interpolant, contents.parameters.tunnel_height, {}};
    const bool is_wide = std::any_of(contents.arrays.begin(), contents.arrays.end(),
                                     [](const StoredArray& a) { return a.name == kTowardsOutside && a.type == "uint64"; });
    if (is_wide) {
        arcs.arrays = read_arcs<std::uint64_t>(store, samples, context);
    } else {
        arcs.arrays = read_arcs<std::uint32_t>(store, samples, context);
    }
    return arcs;
}

Analysis analysis_of(const Container& store, const Context& context) { return with_trees(store, nullptr, context); }

Analysis zoned_analysis_of(const Container& store, const VolumeView& volume, const Context& context) {
    Analysis analysis = with_trees(store, volume.bytes, context);
    if (!add_zones(analysis, volume, context)) contradiction(store, "the trees are not those of the samples");
    return analysis;
}

}  // namespace isoatlas
