#include "store/brick_reader.h"

#include <algorithm>

#include "base/parallel.h"
#include "isoatlas/error.h"
#include "store/brick_codec.h"
#include "store/checksum.h"

namespace isoatlas::store {
namespace {

constexpr std::int64_t kGap = 16 << 10;       ///< bytes between two bricks that are cheaper to read than to skip
constexpr std::int64_t kLongest = 256 << 10;  ///< bytes of one read

[[noreturn]] void damaged(const Container& store, std::int64_t brick, const char* what) {
    throw Error(ErrorKind::input, {.file = store.path(),
                                   .where = "brick " + std::to_string(brick),
                                   .what = what,
                                   .next = "the store is damaged: build it again from the volume"});
}

}  // namespace

template <class T>
BrickReader<T>::BrickReader(const Container& store)
    : store_(store),
      data_(store.contents().array("volume/data", "uint8")),
      grid_(store.contents().volume.extent),
      offset_(store.all<std::uint64_t>("volume/offset", "uint64")),
      sums_(store.all<std::uint64_t>("volume/checksum", "uint64")),
      bits_(store.all<std::uint8_t>("volume/bits", "uint8")),
      low_(store.all<T>("volume/low", name_of(value_type_of<T>))),
      high_(store.all<T>("volume/high", name_of(value_type_of<T>))) {
    const auto count = static_cast<std::size_t>(grid_.count());
    if (offset_.size() != count || sums_.size() != count || bits_.size() != count || low_.size() != count || high_.size() != count)
        damaged(store, 0, "the numbers of bricks do not agree");
    for (std::int64_t brick = 0; brick < grid_.count(); ++brick) {
        const auto i = static_cast<std::size_t>(brick);
        const auto bytes = static_cast<std::uint64_t>(data_.bytes());
        if (bits_[i] > 8 * sizeof(T) || offset_[i] > bytes || static_cast<std::uint64_t>(bytes_of(brick)) > bytes - offset_[i])
            damaged(store, brick, "it lies outside the data");
    }
}

template <class T>
std::int64_t BrickReader<T>::bytes_of(std::int64_t brick) const {
    return packed_bytes(grid_.box(brick).count(), bits_[static_cast<std::size_t>(brick)]);
}

template <class T>
auto BrickReader<T>::extents_of(std::span<const std::int64_t> bricks) const -> std::vector<Extent> {
    std::vector<Extent> extents;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        const auto begin = static_cast<std::int64_t>(offset_[static_cast<std::size_t>(bricks[i])]), end = begin + bytes_of(bricks[i]);
        if (!extents.empty() && begin - extents.back().end <= kGap && end - extents.back().begin <= kLongest) {
            extents.back().last = i + 1;
            extents.back().end = std::max(extents.back().end, end);
        } else {
            extents.push_back({i, i + 1, begin, end});
        }
    }
    return extents;
}

template <class T>
void BrickReader<T>::decode(std::int64_t brick, std::span<const std::byte> packed,
                            const std::function<void(std::int64_t, std::span<const T>)>& sink) const {
    const auto i = static_cast<std::size_t>(brick);
    if (checksum(packed) != sums_[i]) damaged(store_, brick, "its checksum is wrong");
    std::array<T, kBrickSide * kBrickSide * kBrickSide> samples;
    const std::span<T> box(samples.data(), static_cast<std::size_t>(grid_.box(brick).count()));
    decode_brick<T>(packed, low_[i], bits_[i], box);
    sink(brick, box);
}

template <class T>
IoCounters BrickReader<T>::read(std::vector<std::int64_t> bricks, int threads,
                                const std::function<void(std::int64_t, std::span<const T>)>& sink) const {
    const auto offset = [&](std::int64_t brick) { return std::pair(offset_[static_cast<std::size_t>(brick)], brick); };
    std::sort(bricks.begin(), bricks.end(), [&](std::int64_t p, std::int64_t q) { return offset(p) < offset(q); });
    const std::vector<Extent> extents = extents_of(bricks);
    IoCounters counters{0, 0, static_cast<std::int64_t>(bricks.size())};
    for (const Extent& extent : extents) {
        counters.bytes += extent.end - extent.begin;
        counters.extents += extent.end > extent.begin;
    }
    for_each_block(threads, static_cast<std::int64_t>(extents.size()), [&](std::int64_t e) {
        const Extent& extent = extents[static_cast<std::size_t>(e)];
        std::vector<std::byte> bytes(static_cast<std::size_t>(extent.end - extent.begin));
        if (!bytes.empty()) store_.read_unchecked(data_, extent.begin, bytes);
        for (std::size_t i = extent.first; i < extent.last; ++i) {
            const std::int64_t brick = bricks[i],
                               begin = static_cast<std::int64_t>(offset_[static_cast<std::size_t>(brick)]) - extent.begin;
            decode(brick, std::span(bytes).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(bytes_of(brick))), sink);
        }
    });
    return counters;
}

template class BrickReader<std::uint8_t>;
template class BrickReader<std::int8_t>;
template class BrickReader<std::uint16_t>;
template class BrickReader<std::int16_t>;
template class BrickReader<std::uint32_t>;
template class BrickReader<std::int32_t>;
template class BrickReader<float>;
template class BrickReader<double>;

}  // namespace isoatlas::store
