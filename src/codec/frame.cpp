#include "codec/frame.h"

#include <algorithm>
#include <cstring>

#include "codec/checksum.h"

namespace isoatlas {
namespace {

constexpr char kName[16] = "isoatlas frame\n";  // and a zero byte

struct End {
    std::uint64_t ranges, checksum, trailer_checksum;
    char name[16];
};
static_assert(sizeof(End) == kTrailerEnd);

/// The bytes under the checksum of the trailer: all before it.
std::span<const std::byte> checked(std::span<const std::byte> trailer) {
    return trailer.first(trailer.size() - sizeof kName - sizeof(std::uint64_t));
}

}  // namespace

std::vector<ByteRange> outside(std::vector<ByteRange> ranges, std::uint64_t size) {
    std::ranges::sort(ranges, {}, &ByteRange::offset);
    std::vector<ByteRange> gaps;
    std::uint64_t end = 0;
    for (const ByteRange& range : ranges) {
        if (range.bytes == 0) continue;
        if (range.offset > end) gaps.push_back({end, range.offset - end});
        end = std::max(end, range.offset + range.bytes);
    }
    if (size > end) gaps.push_back({end, size - end});
    return gaps;
}

std::vector<std::byte> bytes_of_trailer(const StoreFrame& frame) {
    const std::span<const std::byte> ranges = std::as_bytes(std::span(frame.ranges));
    std::vector<std::byte> bytes(ranges.size() + sizeof(End));
    std::ranges::copy(ranges, bytes.begin());
    End end{frame.ranges.size(), frame.checksum, 0, {}};
    std::memcpy(end.name, kName, sizeof kName);
    std::memcpy(bytes.data() + ranges.size(), &end, sizeof end);
    end.trailer_checksum = checksum(checked(bytes));
    std::memcpy(bytes.data() + ranges.size(), &end, sizeof end);
    return bytes;
}

std::optional<std::int64_t> trailer_bytes(std::span<const std::byte> end, std::int64_t file_size) {
    End raw;
    if (end.size() != sizeof raw) return std::nullopt;
    std::memcpy(&raw, end.data(), sizeof raw);
    const auto room = static_cast<std::uint64_t>(file_size - kTrailerEnd) / sizeof(ByteRange);
    if (std::memcmp(raw.name, kName, sizeof kName) != 0 || raw.ranges > room) return std::nullopt;
    return static_cast<std::int64_t>(raw.ranges * sizeof(ByteRange)) + kTrailerEnd;
}

std::optional<StoreFrame> frame_of_trailer(std::span<const std::byte> trailer, std::int64_t file_size) {
    End end;
    std::memcpy(&end, trailer.data() + trailer.size() - sizeof end, sizeof end);
    if (end.trailer_checksum != checksum(checked(trailer))) return std::nullopt;
    StoreFrame frame{std::vector<ByteRange>(static_cast<std::size_t>(end.ranges)), end.checksum};
    std::memcpy(frame.ranges.data(), trailer.data(), frame.ranges.size() * sizeof(ByteRange));
    const std::uint64_t last = static_cast<std::uint64_t>(file_size) - trailer.size();
    std::uint64_t before = 0;
    for (const ByteRange& range : frame.ranges) {
        if (range.offset < before || range.offset > last || range.bytes > last - range.offset) return std::nullopt;
        before = range.offset + range.bytes;
    }
    return frame;
}

}  // namespace isoatlas
