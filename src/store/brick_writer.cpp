#include "store/brick_writer.h"

#include <algorithm>
#include <cstring>
#include <tuple>

#include "base/check.h"
#include "base/parallel.h"
#include "codec/brick_codec.h"
#include "codec/checksum.h"
#include "codec/sample_keys.h"
#include "field/brick_extremes.h"
#include "field/brick_grid.h"

namespace isoatlas {
namespace {

/// Copies the samples of a box, x fastest.
template <class T>
void copy_box(std::span<const T> samples, const Extent& extent, const Box& box, std::vector<T>& out) {
    out.resize(static_cast<std::size_t>(box.count()));
    T* to = out.data();
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
            std::memcpy(to, samples.data() + extent.index(box.begin[0], y, z), static_cast<std::size_t>(box.size(0)) * sizeof(T));
            to += box.size(0);
        }
    }
}

constexpr std::int64_t kTogether = 512;  // bricks of one task, and of one buffer

/// work(brick) for all bricks, in parallel.
void for_each_brick(const BrickGrid& grid, int threads, const auto& work) {
    for_each_block(threads, (grid.count() + kTogether - 1) / kTogether, [&](std::int64_t block) {
        for (std::int64_t i = block * kTogether; i < std::min((block + 1) * kTogether, grid.count()); ++i) work(BrickId(i));
    });
}

PackedArray array_of_bricks(const char* name, const char* type, const BrickGrid& grid, std::function<void(const ByteSink&)> feed) {
    return {name, type, {grid.size[2], grid.size[1], grid.size[0]}, kPackedBlock, std::move(feed)};
}

template <class T>
struct Bricks {
    std::span<const T> samples;
    BrickGrid grid;
    int threads;
    std::vector<BrickId> order;
    std::vector<std::uint64_t> offset, sums;
    std::vector<std::uint16_t> packed_bytes;
    std::vector<std::uint8_t> heads;  ///< how a brick is coded
    std::vector<T> low, high;
    std::vector<std::uint16_t> lowest, highest;
    std::int64_t bytes = 0;
    bool are_chosen = true;

    /// stored_heads: empty, or the codes.
    Bricks(std::span<const T> values, const Extent& extent, int thread_count, std::vector<std::uint8_t> stored_heads)
        : samples(values), grid(extent), threads(thread_count), order(grid.file_order()), heads(std::move(stored_heads)) {
        const auto count = static_cast<std::size_t>(grid.count());
        ISOATLAS_CHECK(heads.empty() || heads.size() == count);
        are_chosen = heads.empty();
        offset.resize(count), sums.resize(count), packed_bytes.resize(count), heads.resize(count);
        low.resize(count), high.resize(count);
        lowest.resize(count), highest.resize(count);
        for_each_brick(grid, threads, [this](BrickId brick) { measure(brick); });
        for (const BrickId brick : order) {
            offset[brick.index()] = static_cast<std::uint64_t>(bytes);
            bytes += packed_bytes[brick.index()];
        }
    }

    void measure(BrickId brick) {
        std::vector<T> values;
        copy_box(samples, grid.extent, grid.box(brick), values);
        std::tie(low[brick.index()], high[brick.index()]) = extremes_of<T>(values);
        if (!is_constant(brick)) {
            const Index3 size = grid.box(brick).size();
            const T lowest_value = low[brick.index()];
            const BrickCode code =
                are_chosen ? choose_code<T>(values, size, lowest_value) : code_as<T>(values, size, lowest_value, heads[brick.index()]);
            heads[brick.index()] = code.head;
            packed_bytes[brick.index()] = static_cast<std::uint16_t>(code.bytes);
        }
        const ExtremePlaces places = extreme_places<T>(values);
        lowest[brick.index()] = places.lowest, highest[brick.index()] = places.highest;
    }

    [[nodiscard]] bool is_constant(BrickId brick) const { return key_of(low[brick.index()]) == key_of(high[brick.index()]); }

    void encode(BrickId brick, std::vector<std::byte>& packed) {
        packed.clear();
        if (!is_constant(brick)) {
            std::vector<T> values;
            const Box box = grid.box(brick);
            copy_box(samples, grid.extent, box, values);
            encode_brick<T>(values, box.size(), low[brick.index()], heads[brick.index()], packed);
            ISOATLAS_CHECK(packed.size() == packed_bytes[brick.index()]);
        }
        sums[brick.index()] = checksum(packed);
    }

    void feed(const ByteSink& put) {
        std::vector<std::vector<std::byte>> packed(kTogether);
        for (std::int64_t first = 0; first < grid.count(); first += kTogether) {
            const std::int64_t count = std::min(kTogether, grid.count() - first);
            for_each_block(threads, count, [&](std::int64_t i) { encode(order[first + i], packed[i]); });
            for (std::int64_t i = 0; i < count; ++i) put(packed[i]);
        }
    }
};

}  // namespace

std::vector<PackedArray> brick_arrays(const VolumeView& volume, const Context& context, std::vector<std::uint8_t> heads) {
    std::vector<PackedArray> arrays;
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const auto bricks = std::make_shared<Bricks<T>>(samples, volume.info->extent, context.threads, std::move(heads));
        const auto add = [&]<class N>(const char* name, const char* type, const std::vector<N>& numbers) {
            arrays.push_back(array_of_bricks(name, type, bricks->grid,
                                             [bricks, &numbers](const ByteSink& put) { put(std::as_bytes(std::span(numbers))); }));
        };
        arrays.push_back({"volume/data", "uint8", {bricks->bytes}, 0, [bricks](const ByteSink& put) { bricks->feed(put); }});
        add("volume/offset", "uint64", bricks->offset);
        add("volume/bytes", "uint16", bricks->packed_bytes);
        add("volume/low", name_of(volume.info->type), bricks->low);
        add("volume/high", name_of(volume.info->type), bricks->high);
        add("volume/lowest", "uint16", bricks->lowest);
        add("volume/highest", "uint16", bricks->highest);
        add("volume/checksum", "uint64", bricks->sums);
    });
    return arrays;
}

std::vector<PackedArray> brick_place_arrays(const VolumeView& volume, const Context& context) {
    const BrickGrid grid(volume.info->extent);
    const auto places = std::make_shared<std::vector<ExtremePlaces>>(static_cast<std::size_t>(grid.count()));
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        for_each_brick(grid, context.threads, [&](BrickId brick) {
            std::vector<T> values;
            copy_box(samples, grid.extent, grid.box(brick), values);
            (*places)[brick.index()] = extreme_places<T>(values);
        });
    });
    const auto array = [&](const char* name, std::uint16_t ExtremePlaces::* place) {
        return array_of_bricks(name, "uint16", grid, [places, place](const ByteSink& put) {
            std::vector<std::uint16_t> numbers;
            for (const ExtremePlaces& both : *places) numbers.push_back(both.*place);
            put(std::as_bytes(std::span<const std::uint16_t>(numbers)));
        });
    };
    return {array("volume/lowest", &ExtremePlaces::lowest), array("volume/highest", &ExtremePlaces::highest)};
}

}  // namespace isoatlas
