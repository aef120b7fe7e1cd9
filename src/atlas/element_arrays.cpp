#include "atlas/element_arrays.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

#include "atlas/element_form.h"
#include "base/cancel.h"
#include "base/parallel_sort.h"
#include "base/streamed.h"
#include "critical/bodies.h"
#include "critical/element_values.h"
#include "critical/sort_codes.h"
#include "field/order.h"
#include "store/brick_reader.h"
#include "store/pack.h"
#include "store/typed_arrays.h"

namespace isoatlas {
namespace {

constexpr const char* kValue = "elements/value";
constexpr const char* kPlace = "elements/place";
constexpr const char* kForm = "elements/form";

constexpr std::size_t kTogether = std::size_t{1} << 16;  // numbers encoded or decoded at once

/// An array computed in pieces while the store is written: make(item) of all items.
template <class N, class Item, class Make>
PackedArray made_of(const char* name, std::span<const Item> items, const Make& make) {
    PackedArray array = packed_chunks<N>(name, type_name<N>(), items.size());
    array.feed = [items, make](const ByteSink& put) {
        std::vector<N> numbers;
        for (std::size_t first = 0; first < items.size(); first += kTogether) {
            const auto part = items.subspan(first, std::min(kTogether, items.size() - first));
            numbers.resize(part.size());
            std::transform(part.begin(), part.end(), numbers.begin(), make);
            put(std::as_bytes(std::span<const N>(numbers)));
        }
    };
    return array;
}

bool is_dense(std::size_t elements, const VolumeInfo& volume) { return static_cast<std::int64_t>(elements) > volume.extent.voxels() / 2; }

/// Ascending by place, then form.
constexpr std::uint64_t grid_key(ElementForm element) { return static_cast<std::uint64_t>(element.place) << 16 | element.form; }
constexpr ElementForm element_of(std::uint64_t key) {
    return {static_cast<std::int64_t>(key >> 16), static_cast<std::uint16_t>(key & 0xffff)};
}

BigVector<std::uint64_t> sorted_grid_keys(std::span<const std::uint64_t> codes, int threads) {
    constexpr std::size_t kKeys = std::size_t{1} << 18;  // of a chunk: large enough to be released when memory is short
    std::vector<BigVector<std::uint64_t>> chunks((codes.size() + kKeys - 1) / kKeys);
    for (const Block block : streamed_blocks(codes.size(), kKeys)) {
        const auto some = codes.subspan(block.first, block.size());
        BigVector<std::uint64_t>& chunk = chunks[block.first / kKeys];
        chunk.resize(some.size());
        std::transform(some.begin(), some.end(), chunk.begin(), [](std::uint64_t code) { return grid_key(form_of(ElementCode{code})); });
    }
    BigVector<std::uint64_t> keys;
    sort_chunks(
        threads, std::move(chunks), [](std::uint64_t key) { return static_cast<double>(key >> 16); }, std::less<>(),
        [&](std::size_t n) { keys.resize(n); },
        [&](std::size_t first, std::span<const std::uint64_t> some) {
            write_part<std::uint64_t>(std::span(keys).subspan(first, some.size()), some);
        });
    return keys;
}

/// All samples of a store with more critical elements than half of them.
BigVector<std::byte> all_samples(const Container& store, const Context& context) {
    const VolumeInfo& volume = store.contents().volume;
    BigVector<std::byte> samples(static_cast<std::size_t>(volume.extent.voxels()) * size_of(volume.type));
    visit_type(volume.type, [&]<class T>(T) {
        const BrickReader<T> bricks(store);
        (void)bricks.read_all(std::span<T>(reinterpret_cast<T*>(samples.data()), samples.size() / sizeof(T)), context);
    });
    return samples;
}

/// The value as a sample: integers are rounded down, so that order stays.
template <class T>
T rounded(double value) {
    return static_cast<T>(std::is_floating_point_v<T> ? value : std::floor(value));
}

/// Rules of the values of a store's saddles.
SaddleValues saddle_values_of(const Container& store) {
    return store.contents().version < kFirstExactVersion ? SaddleValues::earlier : SaddleValues::exact;
}

/// Rounded values, unchanged.
void restore_values(const Container& store, const VolumeView& volume, double height, int threads, std::span<const std::uint64_t> codes,
                    BigVector<double>& values) {
    values.resize(codes.size());
    find_element_values(codes, volume, height, threads, values, saddle_values_of(store));
    visit_type(volume.info->type, [&]<class T>(T) {
        BigVector<T> stored;
        read_array(store, kValue, name_of(volume.info->type), stored);
        bool is_same = stored.size() == values.size();
        for (std::size_t i = 0; is_same && i < stored.size(); ++i) is_same = !std::isnan(values[i]) && rounded<T>(values[i]) == stored[i];
        if (!is_same) contradiction(store, "values of critical elements are not those of the samples");
    });
}

/// Decodes places and forms to codes, one chunk per thread at a time. ascending: they must be in the order of the grid.
template <class Id>
void read_codes(const Container& store, bool ascending, BigVector<std::uint64_t>& codes) {
    const StoredArray &places = store.contents().array(kPlace, type_name<Id>()), &forms = store.contents().array(kForm, "uint16");
    if (places.count() != forms.count()) contradiction(store, "arrays of the same things have different lengths");
    codes.resize(static_cast<std::size_t>(places.count()));
    const std::int64_t voxels = store.contents().volume.extent.voxels();
    std::vector<Id> place;
    std::vector<std::uint16_t> form;
    std::uint64_t last = 0;
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
            const std::uint64_t key = grid_key(element) + 1;
            if (ascending && key <= std::exchange(last, key)) contradiction(store, "critical elements are not in the order of the grid");
            codes[first + i] = code.bits;
        }
    }
}

}  // namespace

template <class Id>
std::vector<PackedArray> element_arrays(std::span<const double> values, std::span<const std::uint64_t> codes, const VolumeInfo& volume,
                                        int threads) {
    const auto place = [](ElementForm element) { return static_cast<Id>(element.place); };
    const auto form = [](ElementForm element) { return element.form; };
    std::vector<PackedArray> arrays;
    if (!is_dense(codes.size(), volume)) {
        arrays.push_back(packed_chunks<double>(kValue, "float64", values));
        arrays.push_back(made_of<Id>(kPlace, codes, [=](std::uint64_t code) { return place(form_of(ElementCode{code})); }));
        arrays.push_back(made_of<std::uint16_t>(kForm, codes, [=](std::uint64_t code) { return form(form_of(ElementCode{code})); }));
        return arrays;
    }
    const auto keys = std::make_shared<const BigVector<std::uint64_t>>(sorted_grid_keys(codes, threads));
    const std::span<const std::uint64_t> all(*keys);
    arrays.push_back(made_of<Id>(kPlace, all, [keys, place](std::uint64_t key) { return place(element_of(key)); }));
    arrays.push_back(made_of<std::uint16_t>(kForm, all, [keys, form](std::uint64_t key) { return form(element_of(key)); }));
    return arrays;
}

template <class Id>
void read_elements(const Container& store, const std::byte* samples, const Context& context, BigVector<std::uint64_t>& codes,
                   BigVector<double>& values) {
    const Contents& contents = store.contents();
    const bool has_values = std::ranges::any_of(contents.arrays, [](const StoredArray& array) { return array.name == kValue; });
    read_codes<Id>(store, !has_values, codes);
    stop_if_cancelled(context);
    const bool dense = is_dense(codes.size(), contents.volume);
    if (!dense && !has_values) contradiction(store, "values of critical elements are missing");
    if (!dense || (has_values && contents.volume.type == ValueType::f64)) return read_array(store, kValue, type_name<double>(), values);
    BigVector<std::byte> own;
    if (samples == nullptr) own = all_samples(store, context);
    const VolumeView volume{contents.volume, samples == nullptr ? own.data() : samples};
    const double height = tunnel_height_of(contents.parameters.interpolant, contents.parameters.tunnel_height);
    if (has_values) return restore_values(store, volume, height, context.threads, codes, values);
    if (!sort_codes(volume, height, context.threads, codes, values, saddle_values_of(store)))
        contradiction(store, "critical elements are not those of the samples");
}

#define ISOATLAS_ELEMENTS(Id)                                                                                                              \
    template std::vector<PackedArray> element_arrays<Id>(std::span<const double>, std::span<const std::uint64_t>, const VolumeInfo&, int); \
    template void read_elements<Id>(const Container&, const std::byte*, const Context&, BigVector<std::uint64_t>&, BigVector<double>&);
ISOATLAS_ELEMENTS(std::uint32_t)
ISOATLAS_ELEMENTS(std::uint64_t)
#undef ISOATLAS_ELEMENTS

}  // namespace isoatlas
