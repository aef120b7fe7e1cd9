// The sources of a virtual array: names and selections, which HDF5 decodes before it looks at their checksum.
#include <array>
#include <bit>

#include "formats/volume/hdf5_check.h"
#include "formats/volume/hdf5_cursor.h"

namespace isoatlas {
namespace {

constexpr std::uint64_t kMaxRank = 32, kMaxBlocks = 100'000;  // HDF5 merges blocks in quadratic time

/// Bob Jenkins' lookup3, http://burtleburtle.net/bob/c/lookup3.c: HDF5's checksum of its structures.
std::uint32_t lookup3(std::span<const std::byte> bytes) {
    std::uint32_t a = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size()), b = a, c = a;
    const auto add = [&](std::span<const std::byte> part) {
        std::array<std::byte, 12> whole{};
        std::ranges::copy(part, whole.begin());
        const auto word = [&](std::size_t at) { return static_cast<std::uint32_t>(hdf5_number(whole, at, 4)); };
        a += word(0), b += word(4), c += word(8);
    };
    const auto mix = [](std::uint32_t& x, std::uint32_t& y, std::uint32_t& z, int bits) { x -= z, x ^= std::rotl(z, bits), z += y; };
    for (; bytes.size() > 12; bytes = bytes.subspan(12)) {
        add(bytes.first(12));
        mix(a, b, c, 4), mix(b, c, a, 6), mix(c, a, b, 8), mix(a, b, c, 16), mix(b, c, a, 19), mix(c, a, b, 4);
    }
    if (bytes.empty()) return c;
    add(bytes);
    const auto end = [](std::uint32_t& x, std::uint32_t y, int bits) { x ^= y, x -= std::rotl(y, bits); };
    end(c, b, 14), end(a, c, 11), end(b, a, 25), end(c, b, 16), end(a, c, 4), end(b, a, 14), end(c, b, 24);
    return c;
}

/// A selection of points, of blocks, or of all or no samples.
void skip_selection(Hdf5Cursor& cursor, std::uint64_t& blocks) {
    constexpr std::uint64_t kPoints = 1, kBlocks = 2;
    const std::uint64_t kind = cursor.number(4), version = cursor.number(4);
    if (kind != kPoints && kind != kBlocks) {
        cursor.skip(8);
        return;
    }
    std::uint64_t flags = 0, width = 4;
    if (version == 1)
        cursor.skip(8);
    else if (kind == kBlocks && version == 2)
        flags = cursor.number(1), cursor.skip(4), width = 8;
    else  // of HDF5 1.12, with the width of numbers
        flags = kind == kBlocks ? cursor.number(1) : 0, width = cursor.number(1);
    const std::uint64_t rank = cursor.number(4);
    if (rank == 0 || rank > kMaxRank || (width != 2 && width != 4 && width != 8)) cursor.is_sound = false;
    if (!cursor.is_sound) return;
    if (kind == kBlocks && (flags & 1) != 0) {  // start, stride, count, block
        cursor.skip(4 * rank * width);
        return;
    }
    const std::uint64_t count = cursor.number(static_cast<std::size_t>(width));
    blocks += count <= kMaxBlocks ? count : kMaxBlocks + 1;
    if (blocks > kMaxBlocks) cursor.is_sound = false;
    cursor.skip(count * rank * width * (kind == kBlocks ? 2 : 1));
}

}  // namespace

bool is_sound_hdf5_source_list(const Hdf5Frame& frame, std::span<const std::byte> bytes) {
    constexpr std::size_t kChecksum = 4;
    if (bytes.size() < 1 + frame.length_bytes + kChecksum) return false;
    const auto content = bytes.first(bytes.size() - kChecksum);
    if (hdf5_number(bytes, content.size(), kChecksum) != lookup3(content)) return false;
    Hdf5Cursor cursor{content};
    if (cursor.number(1) != 0) return true;  // HDF5 refuses versions that it does not know
    const std::uint64_t count = cursor.number(frame.length_bytes);
    std::uint64_t blocks = 0;
    if (count > content.size()) return false;  // no memory for more
    for (std::uint64_t i = 0; i < count && cursor.is_sound; ++i) {
        constexpr std::uint64_t kUnpadded = 3;
        cursor.skip_name(kUnpadded), cursor.skip_name(kUnpadded);
        skip_selection(cursor, blocks), skip_selection(cursor, blocks);
    }
    return cursor.is_sound && cursor.at == content.size();
}

}  // namespace isoatlas
