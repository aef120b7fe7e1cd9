#include "formats/volume/hdf5_filters.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "formats/common/field_reader.h"
#include "formats/volume/sample_reader.h"
#include "formats/zarr/codecs.h"

namespace isoatlas {
namespace {

constexpr int kDeflate = 1, kShuffle = 2, kFletcher = 3, kScaleOffset = 6, kBzip2 = 307, kLzf = 32000, kBlosc = 32001, kLz4 = 32004,
              kZstd = 32015;
constexpr std::size_t kChecksumBytes = 4;

using Bytes = std::span<const std::byte>;

std::string too_long(std::size_t most) { return "it stands for more than " + std::to_string(most) + " bytes"; }

template <std::size_t kBytes>
void unshuffle(const std::byte* from, std::size_t count, std::byte* to) {
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t byte = 0; byte < kBytes; ++byte) to[i * kBytes + byte] = from[byte * count + i];
    }
}

/// First all first bytes of the elements, then all second ones, ...; bytes behind the last whole element stay.
std::string undo_shuffle(const Hdf5ChunkFilter& filter, Bytes from, std::vector<std::byte>& out) {
    const std::size_t element = filter.settings.empty() ? 0 : filter.settings[0];
    out.resize(from.size());
    if (element == 0) return "the filter shuffle has no size of elements";
    const std::size_t count = from.size() / element;
    if (element == 2) {
        unshuffle<2>(from.data(), count, out.data());
    } else if (element == 4) {
        unshuffle<4>(from.data(), count, out.data());
    } else if (element == 8) {
        unshuffle<8>(from.data(), count, out.data());
    } else {
        for (std::size_t byte = 0; byte < element && count > 0; ++byte) {
            for (std::size_t i = 0; i < count; ++i) out[i * element + byte] = from[byte * count + i];
        }
    }
    std::copy(from.begin() + static_cast<std::ptrdiff_t>(count * element), from.end(),
              out.begin() + static_cast<std::ptrdiff_t>(count * element));
    return "";
}

std::uint32_t fletcher_of(Bytes bytes) {
    constexpr std::size_t kWithoutOverflow = 360;
    std::uint32_t first = 0, second = 0;
    const auto fold = [](std::uint32_t sum) { return (sum & 0xffffU) + (sum >> 16); };
    const std::size_t words = bytes.size() / 2;
    for (std::size_t word = 0; word < words;) {
        for (const std::size_t end = std::min(words, word + kWithoutOverflow); word < end; ++word) {
            first += std::to_integer<std::uint32_t>(bytes[2 * word]) << 8 | std::to_integer<std::uint32_t>(bytes[2 * word + 1]);
            second += first;
        }
        first = fold(first), second = fold(second);
    }
    if (bytes.size() % 2 != 0) {
        first += std::to_integer<std::uint32_t>(bytes.back()) << 8;
        second += first;
        first = fold(first), second = fold(second);
    }
    return fold(second) << 16 | fold(first);
}

std::string undo_fletcher(Bytes from, std::vector<std::byte>& out) {
    if (from.size() < kChecksumBytes) return "the checksum is missing";
    const Bytes bytes = from.first(from.size() - kChecksumBytes);
    const auto stored = FieldReader(from, false).at<std::uint32_t>(bytes.size()), sum = fletcher_of(bytes);
    const std::uint32_t swapped = (sum & 0x00ff00ffU) << 8 | (sum & 0xff00ff00U) >> 8;  // as HDF5 before 1.6.3 wrote it
    if (stored != sum && stored != swapped) return "the checksum (Fletcher32) is wrong";
    out.assign(bytes.begin(), bytes.end());
    return "";
}

/// Runs of literals, and copies of what came at most 8 KiB before.
std::string undo_lzf(Bytes from, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kRatio = 132;
    constexpr unsigned kLiterals = 32, kLongCopy = 7;
    out.resize(from.size() > most / kRatio ? most : from.size() * kRatio);
    std::size_t read = 0, written = 0;
    while (read < from.size()) {
        const auto control = std::to_integer<unsigned>(from[read++]);
        if (control < kLiterals) {
            const std::size_t count = control + 1;
            if (count > from.size() - read) return "the compressed stream ends early";
            if (count > out.size() - written) return too_long(most);
            std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(read), count, out.begin() + static_cast<std::ptrdiff_t>(written));
            read += count, written += count;
            continue;
        }
        std::size_t count = control >> 5;
        if (from.size() - read < (count == kLongCopy ? 2 : 1)) return "the compressed stream ends early";
        if (count == kLongCopy) count += std::to_integer<std::size_t>(from[read++]);
        count += 2;
        const std::size_t back = ((control & 0x1fU) << 8 | std::to_integer<unsigned>(from[read++])) + 1;
        if (back > written) return "the compressed stream is damaged";
        if (count > out.size() - written) return too_long(most);
        for (std::size_t i = 0; i < count; ++i, ++written) out[written] = out[written - back];  // they may overlap
    }
    out.resize(written);
    return "";
}

std::uint32_t big_endian(Bytes bytes, std::size_t at) { return FieldReader(bytes, true).at<std::uint32_t>(at); }

/// The size in 8 bytes, that of a block in 4; then each block behind its own size, not compressed where that is the one of a block.
std::string undo_lz4(Bytes from, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kHeader = 12;
    if (from.size() < kHeader) return "the header of lz4 ends early";
    const auto size = FieldReader(from, true).at<std::uint64_t>(0);
    const std::size_t block = big_endian(from, 8);
    if (size > most) return too_long(most);
    if (block == 0 && size > 0) return "the header of lz4 is damaged";
    out.clear();
    std::vector<std::byte> one, decoded;
    for (std::size_t read = kHeader; out.size() < size;) {
        const std::size_t wanted = std::min<std::size_t>(block, static_cast<std::size_t>(size) - out.size());
        if (from.size() - read < 4) return "the compressed stream ends early";
        const std::size_t stored = big_endian(from, read);
        read += 4;
        if (stored > from.size() - read) return "the compressed stream ends early";
        const Bytes bytes = from.subspan(read, stored);
        read += stored;
        if (stored == wanted) {
            out.insert(out.end(), bytes.begin(), bytes.end());
            continue;
        }
        one.clear();  // as the codec of Zarr has it: the size in front
        for (int bit = 0; bit < 32; bit += 8) one.push_back(static_cast<std::byte>(wanted >> bit));
        one.insert(one.end(), bytes.begin(), bytes.end());
        if (std::string error = decode({.kind = ByteCodec::Kind::lz4}, one, wanted, decoded); !error.empty()) return error;
        out.insert(out.end(), decoded.begin(), decoded.end());
    }
    return "";
}

/// What the filter scale-offset says of its integers.
struct ScaleOffset {
    std::size_t count = 0, element = 0;
    bool big_endian = false, has_fill = false;
    std::uint64_t fill = 0;
};

bool read_settings(const Hdf5ChunkFilter& filter, ScaleOffset& found) {
    constexpr std::size_t kSettings = 20;
    constexpr std::uint32_t kIntegers = 2;
    const std::vector<std::uint32_t>& set = filter.settings;  // scale type, factor, count, class, size, sign, order, fill
    if (set.size() != kSettings || set[0] != kIntegers || set[3] != 0) return false;
    found = {.count = set[2], .element = set[4], .big_endian = set[6] == 1, .has_fill = set[7] == 1};
    found.fill = set[8] | static_cast<std::uint64_t>(set[9]) << 32;
    return found.element == 1 || found.element == 2 || found.element == 4 || found.element == 8;
}

/// Differences to the least value in as few bits as they need; all bits set stand for the fill value.
std::string undo_scale_offset(const Hdf5ChunkFilter& filter, Bytes from, std::size_t most, std::vector<std::byte>& out) {
    constexpr std::size_t kHeader = 21;
    ScaleOffset scale;
    if (!read_settings(filter, scale)) return "the settings of the filter scale-offset are damaged";
    if (scale.count > most / scale.element) return too_long(most);
    if (from.size() < kHeader) return "the header of scale-offset ends early";
    const std::uint32_t bits = FieldReader(from, false).at<std::uint32_t>(0);
    const auto least = FieldReader(from, false).at<std::uint64_t>(5);
    const std::size_t whole = 8 * scale.element, bytes = scale.count * scale.element;
    const Bytes packed = from.subspan(kHeader);
    if (bits > whole || std::to_integer<unsigned>(from[4]) != sizeof least) return "the header of scale-offset is damaged";
    if (bits > 0 && scale.count > 8 * packed.size() / bits) return "the stream of scale-offset ends early";
    out.resize(bytes);
    if (bits == whole) {
        if (packed.size() < bytes) return "the stream of scale-offset ends early";
        std::copy_n(packed.begin(), bytes, out.begin());
        if (scale.big_endian) swap_bytes(out, scale.element);
        return "";
    }
    const std::uint64_t filled = (std::uint64_t{1} << bits) - 1;
    std::size_t at = 0;  // the next bit
    for (std::size_t i = 0; i < scale.count; ++i) {
        std::uint64_t value = 0;
        for (std::size_t left = bits; left > 0;) {
            const std::size_t room = 8 - at % 8, some = std::min(room, left);
            const auto byte = std::to_integer<std::uint64_t>(packed[at / 8]);
            value = value << some | (byte >> (room - some) & ((std::uint64_t{1} << some) - 1));
            at += some, left -= some;
        }
        value = scale.has_fill && bits > 0 && value == filled ? scale.fill : value + least;
        for (std::size_t byte = 0; byte < scale.element; ++byte)
            out[i * scale.element + (scale.big_endian ? scale.element - 1 - byte : byte)] = static_cast<std::byte>(value >> 8 * byte);
    }
    return "";
}

std::string undo(const Hdf5ChunkFilter& filter, Bytes from, std::size_t most, std::vector<std::byte>& out) {
    switch (filter.id) {
        case kDeflate: return decode({.kind = ByteCodec::Kind::inflate}, from, most, out);
        case kShuffle: return undo_shuffle(filter, from, out);
        case kFletcher: return undo_fletcher(from, out);
        case kScaleOffset: return undo_scale_offset(filter, from, most, out);
        case kBzip2: return decode({.kind = ByteCodec::Kind::bzip2}, from, most, out);
        case kLzf: return undo_lzf(from, most, out);
        case kBlosc: return decode({.kind = ByteCodec::Kind::blosc}, from, most, out);
        case kLz4: return undo_lz4(from, most, out);
        case kZstd: return decode({.kind = ByteCodec::Kind::zstd}, from, most, out);
        default: break;
    }
    return "the filter " + std::to_string(filter.id) + " is not known";
}

}  // namespace

bool is_known_hdf5_filter(const Hdf5ChunkFilter& filter) {
    constexpr int kKnown[] = {kDeflate, kShuffle, kFletcher, kBzip2, kLzf, kBlosc, kLz4, kZstd};
    ScaleOffset scale;
    return std::ranges::find(kKnown, filter.id) != std::end(kKnown) || (filter.id == kScaleOffset && read_settings(filter, scale));
}

std::string undo_hdf5_filters(std::span<const Hdf5ChunkFilter> filters, std::uint32_t skipped, std::size_t bytes,
                              std::vector<std::byte>& value, std::vector<std::byte>& scratch) {
    constexpr std::size_t kMasked = 32;
    const std::size_t most = bytes + bytes / 8 + (std::size_t{1} << 16);  // between filters: what does not shrink, and checksums
    for (std::size_t i = filters.size(); i-- > 0;) {
        if (i < kMasked && (skipped >> i & 1U) != 0) continue;
        if (std::string error = undo(filters[i], value, i == 0 ? bytes : most, scratch); !error.empty()) return error;
        std::swap(value, scratch);
    }
    if (value.size() == bytes) return "";
    return "it holds " + std::to_string(value.size()) + " bytes instead of " + std::to_string(bytes);
}

}  // namespace isoatlas
