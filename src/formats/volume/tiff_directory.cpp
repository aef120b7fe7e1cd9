#include "formats/volume/tiff_directory.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <set>
#include <utility>

#include "formats/common/file_access.h"

namespace isoatlas {
namespace {

constexpr std::uint16_t kShort = 3, kLong = 4, kStripOffsets = 273, kTileOffsets = 324, kImageDepth = 32997, kTileDepth = 32998;

std::uint64_t number(const std::byte* bytes, std::size_t size, bool big_endian) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | std::to_integer<std::uint64_t>(bytes[big_endian ? i : size - 1 - i]);
    return value;
}

}  // namespace

std::optional<std::vector<TiffEntry>> read_tiff_entries(File& file, const std::string& path, std::uint64_t offset, bool is_big_tiff,
                                                        bool big_endian) {
    const std::size_t count_bytes = is_big_tiff ? 8 : 2, entry_bytes = is_big_tiff ? 20 : 12, link_bytes = is_big_tiff ? 8 : 4;
    const auto file_bytes = static_cast<std::uint64_t>(file.size());
    if (offset > file_bytes || file_bytes - offset < count_bytes) return std::nullopt;
    std::array<std::byte, 8> raw{};
    read_fully(file, path, static_cast<std::int64_t>(offset), std::span(raw).first(count_bytes));
    const std::uint64_t count = number(raw.data(), count_bytes, big_endian), room = file_bytes - offset - count_bytes;
    if (count > room / entry_bytes || count * entry_bytes + link_bytes > room) return std::nullopt;
    std::vector<std::byte> bytes(static_cast<std::size_t>(count) * entry_bytes);
    read_fully(file, path, static_cast<std::int64_t>(offset + count_bytes), bytes);
    std::vector<TiffEntry> entries(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::byte* entry = bytes.data() + i * entry_bytes;
        entries[i] = {static_cast<std::uint16_t>(number(entry, 2, big_endian)),
                      static_cast<std::uint16_t>(number(entry + 2, 2, big_endian)), number(entry + 4, is_big_tiff ? 8 : 4, big_endian)};
    }
    return entries;
}

std::string doubtful_tag(const std::vector<TiffEntry>& entries, int samples) {
    constexpr std::uint16_t kSampleFormat = 339;
    // Tags of TIFF 6.0 that may be one SHORT, without those of bilevel images: these may differ from another one in one bit.
    static constexpr std::array<std::uint16_t, 18> kSound = {255, 256, 257, 258, 259, 262, 266, 273, 274,
                                                             277, 278, 279, 280, 281, 284, 322, 323, 338};
    static constexpr std::array<std::pair<std::uint16_t, const char*>, 4> kDeciding = {
        {{259, "Compression"}, {266, "FillOrder"}, {317, "Predictor"}, {339, "SampleFormat"}}};
    constexpr std::uint16_t kLastType = 18;  // of BigTIFF
    std::set<std::uint16_t> seen;
    for (const TiffEntry& e : entries) {
        if (e.type == 0 || e.type > kLastType) return "tag " + std::to_string(e.tag) + " has no known type";
        if (!seen.insert(e.tag).second) return "tag " + std::to_string(e.tag) + " appears twice";
        const bool is_depth = e.tag == kImageDepth || e.tag == kTileDepth, is_number = e.type == kShort || e.type == kLong;
        if (is_depth && (e.count != 1 || !is_number)) return "tag " + std::to_string(e.tag) + " is not one number of 16 or 32 bits";
    }
    for (const auto& [tag, name] : kDeciding) {
        const auto wanted = tag;
        const auto found = std::find_if(entries.begin(), entries.end(), [wanted](const TiffEntry& e) { return e.tag == wanted; });
        if (found != entries.end()) {
            const bool is_one = found->count == 1 || (tag == kSampleFormat && found->count == static_cast<std::uint64_t>(samples));
            if (found->type != kShort || !is_one) return std::string(name) + " is not one number of 16 bits";
            continue;
        }
        for (const TiffEntry& e : entries) {
            const bool is_near = std::popcount(static_cast<unsigned>(e.tag ^ wanted)) == 1 && e.type == kShort && e.count == 1;
            if (is_near && std::find(kSound.begin(), kSound.end(), e.tag) == kSound.end())
                return "tag " + std::to_string(e.tag) + " differs in one bit from " + name + ", which is missing";
        }
    }
    return {};
}

std::uint64_t pieces_listed(const std::vector<TiffEntry>& entries) {
    for (const TiffEntry& e : entries) {
        if (e.tag == kStripOffsets || e.tag == kTileOffsets) return e.count;
    }
    return 0;
}

}  // namespace isoatlas
