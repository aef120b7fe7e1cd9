#include "store/tree_arrays.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/big_vector.h"
#include "critical/bodies.h"
#include "critical/element_values.h"
#include "field/order.h"
#include "isoatlas/error.h"
#include "store/brick_reader.h"
#include "store/element_form.h"
#include "zones/analysis_data.h"
#include "zones/trees.h"

namespace isoatlas::store {
namespace {

template <class N>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<N, double>) return "float64";
    if constexpr (std::is_same_v<N, std::uint16_t>) return "uint16";
    if constexpr (std::is_same_v<N, std::uint32_t>) return "uint32";
    return "uint64";
}

constexpr const char* kValue = "elements/value";
constexpr const char* kPlace = "elements/place";
constexpr const char* kForm = "elements/form";
constexpr const char* kTowardsOutside = "elements/towards_outside";
constexpr const char* kVoxels = "elements/voxels";

constexpr std::size_t kTogether = std::size_t{1} << 16;  // numbers that are made or taken apart at once

/// Puts make(item) of every item, some at once.
template <class N, class Item, class Make>
void feed_parts(std::span<const Item> items, Make make, const Put& put) {
    std::vector<N> numbers;
    for (std::size_t first = 0; first < items.size(); first += kTogether) {
        const auto part = items.subspan(first, std::min(kTogether, items.size() - first));
        numbers.resize(part.size());
        std::transform(part.begin(), part.end(), numbers.begin(), make);
        put(std::as_bytes(std::span<const N>(numbers)));
    }
}

/// An array whose numbers are made of codes while the store is written.
template <class N, class Make>
PackedArray made_of_codes(const char* name, std::span<const std::uint64_t> codes, Make make) {
    PackedArray array = packed_chunks<N>(name, type_name<N>(), codes.size());
    array.feed = [codes, make](const Put& put) {
        feed_parts<N>(codes, [make](std::uint64_t code) { return make(form_of(ElementCode{code})); }, put);
    };
    return array;
}

[[noreturn]] void contradiction(const Container& store, const char* what) {
    throw Error(ErrorKind::input,
                {.file = store.path(), .where = "trees", .what = what, .next = "the store is damaged: build it again from the volume"});
}

template <class N>
void read_array(const Container& store, const char* name, const char* type, BigVector<N>& numbers) {
    const StoredArray& array = store.contents().array(name, type);
    numbers.resize(static_cast<std::size_t>(array.count()));
    store.read(array, 0, std::as_writable_bytes(std::span<N>(numbers)));
}

/// So many elements that their values are stored as samples are (tree_arrays.h).
bool is_dense(std::int64_t elements, const VolumeInfo& volume) {
    return volume.type != ValueType::f64 && elements > volume.extent.voxels() / 2;
}

/// The value as a sample: integers are rounded down, so that order stays.
template <class T>
T rounded(double value) {
    return static_cast<T>(std::is_floating_point_v<T> ? value : std::floor(value));
}

PackedArray values_of(std::span<const double> values, const VolumeInfo& volume) {
    if (!is_dense(static_cast<std::int64_t>(values.size()), volume)) return packed_chunks<double>(kValue, "float64", values);
    return visit_type(volume.type, [&]<class T>(T) {
        PackedArray array = packed_chunks<T>(kValue, name_of(volume.type), values.size());
        array.feed = [values](const Put& put) { feed_parts<T>(values, rounded<T>, put); };
        return array;
    });
}

/// All samples of a store, which has more critical elements than half of them.
BigVector<std::byte> all_samples(const Container& store, int threads) {
    const VolumeInfo& volume = store.contents().volume;
    BigVector<std::byte> samples(static_cast<std::size_t>(volume.extent.voxels()) * size_of(volume.type));
    visit_type(volume.type, [&]<class T>(T) {
        const BrickReader<T> bricks(store);
        (void)bricks.read_all(std::span<T>(reinterpret_cast<T*>(samples.data()), samples.size() / sizeof(T)), threads);
    });
    return samples;
}

/// Values that were rounded, as they are.
template <class Id>
void restore_values(const Container& store, const std::byte* samples, AnalysisArrays<Id>& arrays, int threads) {
    const Contents& contents = store.contents();
    BigVector<std::byte> own;
    if (samples == nullptr) {
        own = all_samples(store, threads);
        samples = own.data();
    }
    arrays.value.resize(arrays.code.size());
    const double height = tunnel_height_of(contents.parameters.interpolant, contents.parameters.tunnel_height);
    find_element_values(arrays.code, {contents.volume, samples}, height, threads, arrays.value);
    visit_type(contents.volume.type, [&]<class T>(T) {
        BigVector<T> stored;
        read_array(store, kValue, name_of(contents.volume.type), stored);
        bool is_same = stored.size() == arrays.value.size();
        for (std::size_t i = 0; is_same && i < stored.size(); ++i)
            is_same = !std::isnan(arrays.value[i]) && rounded<T>(arrays.value[i]) == stored[i];
        if (!is_same) contradiction(store, "values of critical elements are not those of the samples");
    });
}

/// What the trees are made of without looking: values in order.
template <class Id>
void check(const AnalysisArrays<Id>& a, const Container& store) {
    const std::size_t n = a.value.size();
    if (n == 0) contradiction(store, "there are no critical elements");
    if (a.code.size() != n) contradiction(store, "arrays of the same things have different lengths");
    for (std::size_t i = 0; i < n; ++i) {
        if (!(i == 0 || a.value[i] <= a.value[i - 1]) || std::isnan(a.value[i])) contradiction(store, "values do not descend");
    }
}

/// Places and forms as codes, as many chunks at once as threads may unpack.
template <class Id>
void read_codes(const Container& store, BigVector<std::uint64_t>& codes) {
    const StoredArray &places = store.contents().array(kPlace, type_name<Id>()), &forms = store.contents().array(kForm, "uint16");
    if (places.count() != forms.count()) contradiction(store, "arrays of the same things have different lengths");
    codes.resize(static_cast<std::size_t>(places.count()));
    const std::int64_t voxels = store.contents().volume.extent.voxels();
    std::vector<Id> place;
    std::vector<std::uint16_t> form;
    for (std::size_t first = 0; first < codes.size(); first += place.size()) {
        const std::size_t count = std::min(16 * kTogether, codes.size() - first);
        place.resize(count), form.resize(count);
        store.read(places, static_cast<std::int64_t>(first * sizeof(Id)), std::as_writable_bytes(std::span<Id>(place)));
        store.read(forms, static_cast<std::int64_t>(first * 2), std::as_writable_bytes(std::span<std::uint16_t>(form)));
        for (std::size_t i = 0; i < count; ++i) {
            const ElementForm element{static_cast<std::int64_t>(place[i]), form[i]};
            const ElementCode code = element.place < 0 || element.place >= voxels ? ElementCode{0} : code_of(element);
            const ElementForm found = form_of(code);
            if (found.place != element.place || found.form != element.form || code.h0() > 2 || code.l0() > 2)
                contradiction(store, "a critical element does not exist");
            codes[first + i] = code.bits;
        }
    }
}

template <class Id>
std::unique_ptr<IndexedArrays<Id>> read_arcs(const Container& store, const std::byte* samples, int threads) {
    auto result = std::make_unique<IndexedArrays<Id>>();
    AnalysisArrays<Id>& arrays = result->arrays;
    read_codes<Id>(store, arrays.code);
    if (is_dense(static_cast<std::int64_t>(arrays.code.size()), store.contents().volume)) {
        restore_values(store, samples, arrays, threads);
    } else {
        read_array(store, kValue, type_name<double>(), arrays.value);
    }
    read_array(store, kTowardsOutside, type_name<Id>(), arrays.contours.other);
    check(arrays, store);
    return result;
}

}  // namespace

std::vector<PackedArray> tree_arrays(const Analysis& analysis, const VolumeInfo& volume) {
    std::vector<PackedArray> packs;
    analysis.data().visit([&]<class Id>(const IndexedArrays<Id>& held) {
        const AnalysisArrays<Id>& arrays = held.arrays;
        const std::span<const std::uint64_t> codes(arrays.code);
        packs.push_back(values_of(arrays.value, volume));
        packs.push_back(made_of_codes<Id>(kPlace, codes, [](ElementForm element) { return static_cast<Id>(element.place); }));
        packs.push_back(made_of_codes<std::uint16_t>(kForm, codes, [](ElementForm element) { return element.form; }));
        packs.push_back(packed_chunks<Id>(kTowardsOutside, type_name<Id>(), std::span<const Id>(arrays.contours.other)));
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

Analysis arcs_of(const Container& store, const std::byte* samples, int threads) {
    const Contents& contents = store.contents();
    auto data = std::make_unique<Analysis::Data>();
    data->extent = contents.volume.extent;
    data->interpolant = contents.parameters.interpolant;
    data->tunnel_height = contents.parameters.tunnel_height;
    const bool is_wide = std::any_of(contents.arrays.begin(), contents.arrays.end(),
                                     [](const StoredArray& a) { return a.name == kTowardsOutside && a.type == "uint64"; });
    if (is_wide) {
        data->arrays = read_arcs<std::uint64_t>(store, samples, threads);
    } else {
        data->arrays = read_arcs<std::uint32_t>(store, samples, threads);
    }
    return Analysis(std::move(data));
}

Analysis analysis_of(const Container& store, int threads) {
    Analysis analysis = arcs_of(store, nullptr, threads);
    analysis.data().visit([&]<class Id>(IndexedArrays<Id>& held) {
        AnalysisArrays<Id>& arrays = held.arrays;
        if (!restore_trees(arrays, store.contents().volume.extent.rank, threads)) contradiction(store, "the contour tree is none");
        read_array(store, kVoxels, type_name<Id>(), arrays.element_voxels);
        if (arrays.element_voxels.size() != arrays.value.size()) contradiction(store, "not every element has its number of voxels");
        add_up_voxels(arrays);
        release(arrays.element_voxels);
    });
    return analysis;
}

}  // namespace isoatlas::store
