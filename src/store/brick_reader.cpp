#include "store/brick_reader.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "base/cancel.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/sample_types.h"
#include "codec/brick_codec.h"
#include "codec/checksum.h"
#include "field/brick_extremes.h"
#include "field/negate.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kGap = 1 << 10;            ///< max gap between two bricks that is cheaper to read than to skip
constexpr std::int64_t kLongestRead = 256 << 10;  ///< max bytes of one read

// Prefetched ahead of reading: enough to keep the disk busy.
constexpr std::size_t kExpectedReads = 512;
constexpr std::int64_t kExpectedBytes = 16 << 20;
constexpr std::int64_t kExpectedGap = 16 << 10;  ///< max gap between two reads that are merged into one request

[[noreturn]] void damaged(const Container& store, BrickId brick, const char* what) {
    throw Error(ErrorKind::input, {.file = store.path(),
                                   .where = "brick " + std::to_string(brick.number()),
                                   .what = what,
                                   .next = "the store is damaged: build it again from the volume"});
}

/// The bytes of all bricks. What the index of bricks is read from is fetched together.
const StoredArray& with_fetched_index(const Container& store, const char* samples) {
    std::vector<const StoredArray*> index;
    for (const auto& [name, type] :
         {std::pair("volume/offset", "uint64"), std::pair("volume/checksum", "uint64"), std::pair("volume/bytes", "uint16"),
          std::pair("volume/low", samples), std::pair("volume/high", samples), std::pair("volume/lowest", "uint16"),
          std::pair("volume/highest", "uint16")})
        index.push_back(&store.contents().array(name, type));
    store.fetch(index);
    return store.contents().array("volume/data", "uint8");
}

constexpr const char* kWrongExtremes = "its extremes are not at the stored positions";

}  // namespace

template <class T>
BrickReader<T>::BrickReader(const Container& store)
    : store_(store),
      data_(with_fetched_index(store, name_of(value_type_of<T>))),
      is_negated_(polarity_of(store.contents().volume) == Polarity::low),
      grid_(store.contents().volume.extent),
      offset_(store.all<std::uint64_t>("volume/offset", "uint64")),
      sums_(store.all<std::uint64_t>("volume/checksum", "uint64")),
      bytes_(store.all<std::uint16_t>("volume/bytes", "uint16")),
      low_(store.all<T>("volume/low", name_of(value_type_of<T>))),
      high_(store.all<T>("volume/high", name_of(value_type_of<T>))),
      lowest_(store.all<std::uint16_t>("volume/lowest", "uint16")),
      highest_(store.all<std::uint16_t>("volume/highest", "uint16")) {
    const auto count = static_cast<std::size_t>(grid_.count());
    if (offset_.size() != count || sums_.size() != count || bytes_.size() != count || low_.size() != count || high_.size() != count ||
        lowest_.size() != count || highest_.size() != count)
        damaged(store, BrickId(0), "the numbers of bricks do not agree");
    const auto bytes = static_cast<std::uint64_t>(data_.bytes());
    for (const BrickId brick : grid_.bricks()) {
        const std::size_t i = brick.index();
        if (offset_[i] > bytes || bytes_[i] > bytes - offset_[i]) damaged(store, brick, "it lies outside the data");
    }
    check_places();
    if (!is_negated_) return;
    for (std::vector<T>* values : {&low_, &high_}) std::ranges::transform(*values, values->begin(), negated_sample<T>);
    std::swap(low_, high_);
}

template <class T>
void BrickReader<T>::check_places() const {
    BrickId brick(0);
    for (std::int64_t z = 0; z < grid_.size[2]; ++z) {
        for (std::int64_t y = 0; y < grid_.size[1]; ++y) {
            const std::int64_t rows = grid_.length(1, y) * grid_.length(2, z);
            for (std::int64_t x = 0; x < grid_.size[0]; ++x, ++brick) {
                const std::size_t i = brick.index();
                if (std::max(lowest_[i], highest_[i]) >= rows * grid_.length(0, x)) damaged(store_, brick, "its extremes lie outside");
            }
        }
    }
}

template <class T>
VoxelId BrickReader<T>::voxel_at(BrickId brick, std::int64_t place) const {
    const Box box = grid_.box(brick);
    return VoxelId(grid_.extent.index(box.begin + isoatlas::Extent{3, box.size()}.voxel(place)));
}

template <class T>
auto BrickReader<T>::extents_of(std::span<const BrickId> bricks, std::int64_t longest) const -> std::vector<Extent> {
    std::vector<Extent> extents;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const auto begin = static_cast<std::int64_t>(offset_[bricks[i].index()]), end = begin + bytes_of(bricks[i]);
        if (!extents.empty() && begin - extents.back().end <= kGap && end - extents.back().begin <= longest) {
            extents.back().last = i + 1;
            extents.back().end = std::max(extents.back().end, end);
        } else {
            extents.push_back({i, i + 1, begin, end});
        }
    }
    return extents;
}

template <class T>
void BrickReader<T>::decode(BrickId brick, std::span<const std::byte> packed,
                            const std::function<void(BrickId, std::span<const T>)>& sink) const {
    const std::size_t i = brick.index();
    if (checksum(packed) != sums_[i]) damaged(store_, brick, "its checksum is wrong");
    std::array<T, kBrickSamples> samples;
    const Index3 size = grid_.box(brick).size();
    const std::span<T> box(samples.data(), static_cast<std::size_t>(size.product()));
    const T first = is_negated_ ? negated_sample(high_[i]) : low_[i];  // that of the encoded samples
    if (!decode_brick<T>(packed, size, first, box)) damaged(store_, brick, "it cannot be decoded");
    if (is_negated_) std::ranges::transform(box, box.begin(), negated_sample<T>);
    if (box[lowest_[i]] != low_[i] || box[highest_[i]] != high_[i]) damaged(store_, brick, kWrongExtremes);
    sink(brick, box);
}

template <class T>
void BrickReader<T>::sort_by_offset(std::vector<BrickId>& bricks) const {
    const auto offset = [&](BrickId brick) { return std::pair(offset_[brick.index()], brick); };
    std::sort(bricks.begin(), bricks.end(), [&](BrickId p, BrickId q) { return offset(p) < offset(q); });
}

template <class T>
IoCounters BrickReader<T>::count(std::span<const BrickId> bricks, std::span<const Extent> extents) const {
    IoCounters counters{.bricks = static_cast<std::int64_t>(bricks.size())};
    for (const BrickId brick : bricks) counters.samples += grid_.box(brick).count();
    for (const Extent& extent : extents) {
        counters.bytes += extent.end - extent.begin;
        counters.extents += extent.end > extent.begin;
    }
    return counters;
}

template <class T>
IoCounters BrickReader<T>::cost_of(std::vector<BrickId> bricks) const {
    sort_by_offset(bricks);
    return count(bricks, extents_of(bricks, kLongestRead));
}

// A part may need more reads than the whole, at most one for each brick, and no bytes outside the gaps of the whole.
template <class T>
IoCounters BrickReader<T>::max_of_part(std::vector<BrickId> bricks) const {
    sort_by_offset(bricks);
    IoCounters max = count(bricks, extents_of(bricks, std::numeric_limits<std::int64_t>::max()));
    max.extents = std::count_if(bricks.begin(), bricks.end(), [this](BrickId brick) { return bytes_of(brick) > 0; });
    return max;
}

// Prefetching many extents at a time is several times faster than sequential requests, and reads nothing between them. No prefetch while
// all bytes are in memory.
template <class T>
void BrickReader<T>::prefetch(std::span<const Extent> extents, std::size_t first, Prefetched& prefetched) const {
    const std::size_t end = std::min(first + kExpectedReads, extents.size());
    std::int64_t left = kExpectedBytes;
    std::vector<FileRange> ranges;
    FileRange range;  // nothing prefetched yet
    const auto ask = [&] {
        if (range.bytes() > 0) ranges.push_back(range);
        range = {};
    };
    for (std::size_t i = first; i < end && left > 0; left -= extents[i].end - extents[i].begin, ++i) {
        if (extents[i].end == extents[i].begin) continue;  // bricks of one value have no bytes
        const bool is_asked = prefetched[i].exchange(true, std::memory_order_relaxed);
        if (is_asked || extents[i].begin - range.end > kExpectedGap) ask();
        if (is_asked) continue;
        if (range.bytes() == 0) range.begin = extents[i].begin;
        range.end = extents[i].end;
    }
    ask();
    store_.prefetch(data_, std::move(ranges));
}

template <class T>
IoCounters BrickReader<T>::read(std::vector<BrickId> bricks, const Context& context,
                                const std::function<void(BrickId, std::span<const T>)>& sink) const {
    sort_by_offset(bricks);
    const std::vector<Extent> extents = extents_of(bricks, kLongestRead);
    const IoCounters counters = count(bricks, extents);
    const CallerLooks look(context);
    Prefetched prefetched(extents.size());
    for_each_block(context.threads, static_cast<std::int64_t>(extents.size()), [&](std::int64_t e) {
        look();
        const Extent& extent = extents[static_cast<std::size_t>(e)];
        const auto size = static_cast<std::size_t>(extent.end - extent.begin);
        const auto memory = std::make_unique_for_overwrite<std::byte[]>(size);
        const std::span<std::byte> bytes(memory.get(), size);
        if (!bytes.empty() && !store_.read_if_present(data_, extent.begin, bytes)) {
            prefetch(extents, static_cast<std::size_t>(e), prefetched);
            store_.read_unchecked(data_, extent.begin, bytes);
        }
        for (std::size_t i = extent.first; i < extent.last; ++i) {
            const BrickId brick = bricks[i];
            const std::int64_t begin = static_cast<std::int64_t>(offset_[brick.index()]) - extent.begin;
            decode(brick, bytes.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(bytes_of(brick))), sink);
        }
    });
    return counters;
}

template <class T>
IoCounters BrickReader<T>::read_into(T* whole, std::vector<BrickId> bricks, const Context& context) const {
    return read(std::move(bricks), context, [this, whole](BrickId brick, std::span<const T> samples) {
        const Box box = grid_.box(brick);
        const T* from = samples.data();
        const auto bytes = static_cast<std::size_t>(box.size(0)) * sizeof(T);
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y, from += box.size(0))
                std::memcpy(whole + grid_.extent.index(box.begin[0], y, z), from, bytes);
        }
    });
}

template <class T>
IoCounters BrickReader<T>::read_all(std::span<T> whole, const Context& context) const {
    ISOATLAS_CHECK(static_cast<std::int64_t>(whole.size()) == grid_.extent.voxels());
    return read_into(whole.data(), all_bricks(), context);
}

template <class T>
std::vector<BrickId> BrickReader<T>::all_bricks() const {
    std::vector<BrickId> all;
    all.reserve(static_cast<std::size_t>(grid_.count()));
    for (const BrickId brick : grid_.bricks()) all.push_back(brick);
    return all;
}

template <class T>
void BrickReader<T>::check(const Context& context) const {
    (void)read(all_bricks(), context, [this](BrickId brick, std::span<const T> samples) {
        const std::size_t i = brick.index();
        if (extreme_places(samples) != ExtremePlaces{highest_[i], lowest_[i]}) damaged(store_, brick, kWrongExtremes);
    });
}

std::vector<std::uint8_t> brick_heads(const Container& store) {
    constexpr std::int64_t kPart = 1 << 20;
    const StoredArray& data = store.contents().array("volume/data", "uint8");
    const auto offset = store.all<std::uint64_t>("volume/offset", "uint64");
    const auto bytes = store.all<std::uint16_t>("volume/bytes", "uint16");
    std::vector<std::uint8_t> heads(offset.size(), 0);
    std::vector<std::byte> part;
    std::int64_t begin = 0;
    for (const BrickId brick : BrickGrid(store.contents().volume.extent).file_order()) {
        const std::size_t i = brick.index();
        const auto at = static_cast<std::int64_t>(offset.at(i));
        if (bytes.at(i) == 0 || at < 0 || at >= data.bytes()) continue;
        if (at < begin || at - begin >= std::ssize(part)) {
            begin = at;
            part.resize(static_cast<std::size_t>(std::min(kPart, data.bytes() - begin)));
            store.read_unchecked(data, begin, part);
        }
        heads[i] = static_cast<std::uint8_t>(part[static_cast<std::size_t>(at - begin)]);
    }
    return heads;
}

#define ISOATLAS_INSTANTIATE(T) template class BrickReader<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
