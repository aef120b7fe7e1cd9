#include "formats/volume/hdf5_message_check.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "formats/volume/hdf5_cursor.h"

namespace isoatlas {
namespace {

using Bytes = std::span<const std::byte>;

/// So many bytes are there.
bool has(Bytes bytes, std::uint64_t count) { return bytes.size() >= count; }

/// A size of 4 bytes and as many bytes.
bool skip_sized(Hdf5Cursor& cursor) { return cursor.skip(cursor.number(4)); }

bool is_sound_fill_value(Bytes bytes) {
    constexpr std::uint64_t kHasValue = 0x20;
    Hdf5Cursor cursor{bytes};
    const std::uint64_t version = cursor.number(1);
    if (version >= 3) return (cursor.number(1) & kHasValue) == 0 ? cursor.is_sound : skip_sized(cursor);
    cursor.skip(2);
    const bool has_value = cursor.number(1) != 0 || version == 1;
    return has_value ? skip_sized(cursor) : cursor.is_sound;
}

/// HDF5 follows the list of free blocks of a heap of names for ever where that has no end, and names to their zero.
bool is_sound_heap_of_names(const Hdf5Frame& frame, std::uint64_t heap) {
    constexpr std::uint64_t kNoBlock = 1;
    const std::size_t length = frame.length_bytes;
    std::vector<std::byte> head(8 + 2 * length + frame.address_bytes), block(2 * length), last(1);
    if (!frame.read(heap, head) || std::memcmp(head.data(), "HEAP", 4) != 0) return false;
    const std::uint64_t size = hdf5_number(head, 8, length), data = hdf5_number(head, 8 + 2 * length, frame.address_bytes);
    if (size > frame.rest(data)) return false;
    if (size > 0 && (!frame.read(data + size - 1, last) || last[0] != std::byte{0})) return false;
    std::uint64_t left = size / block.size();
    for (std::uint64_t at = hdf5_number(head, 8 + length, length); at != kNoBlock; at = hdf5_number(block, 0, length)) {
        if (left-- == 0 || at > size || size - at < block.size() || !frame.read(data + at, block)) return false;
    }
    return true;
}

bool is_sound_symbol_table(const Hdf5Frame& frame, Bytes bytes) {
    Hdf5Cursor cursor{bytes};
    cursor.skip(frame.address_bytes);  // a tree
    const std::uint64_t heap = cursor.number(frame.address_bytes);
    return cursor.is_sound && is_sound_heap_of_names(frame, heap);
}

bool are_sound_external_files(const Hdf5Frame& frame, Bytes bytes) {
    Hdf5Cursor cursor{bytes};
    cursor.skip(4 + 2);
    const std::uint64_t files = cursor.number(2), heap = cursor.number(frame.address_bytes);
    return cursor.skip(files * 3 * frame.length_bytes) && is_sound_heap_of_names(frame, heap);
}

/// Heaps and trees of links or attributes that are not in the header: nowhere, or in the file.
bool are_sound_places(const Hdf5Frame& frame, Bytes bytes, std::size_t bytes_of_order) {
    constexpr std::uint64_t kOrder = 1, kSecondTree = 2;
    Hdf5Cursor cursor{bytes};
    cursor.skip(1);
    const std::uint64_t flags = cursor.number(1), places = (flags & kSecondTree) != 0 ? 3 : 2;
    if ((flags & kOrder) != 0) cursor.skip(bytes_of_order);
    for (std::uint64_t i = 0; i < places; ++i) {
        const std::uint64_t address = cursor.number(frame.address_bytes);
        if (!cursor.is_sound || (address != hdf5_nowhere(frame) && frame.rest(address) == 0)) return false;
    }
    return cursor.is_sound;
}

bool is_sound_link(const Hdf5Frame& frame, Bytes bytes) {
    constexpr std::uint64_t kHard = 0, kExternal = 64;
    Hdf5Cursor cursor{bytes};
    const std::uint64_t version = cursor.number(1), flags = cursor.number(1), kind = (flags & 8) != 0 ? cursor.number(1) : kHard;
    cursor.skip(((flags & 4) != 0 ? 8 : 0) + ((flags & 16) != 0 ? 1 : 0));
    cursor.skip(cursor.number(std::size_t{1} << (flags & 3)));  // the name
    if (kind == kHard) return version == 1 && cursor.skip(frame.address_bytes);
    const std::uint64_t size = cursor.number(2);
    const std::size_t begin = cursor.at;
    if (!cursor.skip(size) || version != 1) return false;
    const Bytes target = bytes.subspan(begin, static_cast<std::size_t>(size));  // a file and an object in it, behind one byte
    return kind != kExternal || (size > 0 && std::ranges::count(target.subspan(1), std::byte{0}) >= 2);
}

bool is_sound_group(Bytes bytes) {
    Hdf5Cursor cursor{bytes};
    cursor.skip(1);
    const std::uint64_t flags = cursor.number(1);
    return cursor.skip(((flags & 1) != 0 ? 4 : 0) + ((flags & 2) != 0 ? 4 : 0));
}

bool are_sound_filters(Bytes bytes) {
    constexpr std::uint64_t kFirstOfOthers = 256;  // those of HDF5 itself have no names from version 2 on
    Hdf5Cursor cursor{bytes};
    const std::uint64_t version = cursor.number(1), filters = cursor.number(1);
    if (version == 1) cursor.skip(6);
    for (std::uint64_t i = 0; i < filters && cursor.is_sound; ++i) {
        const std::uint64_t id = cursor.number(2), name = version == 1 || id >= kFirstOfOthers ? cursor.number(2) : 0;
        cursor.skip(2);
        const std::uint64_t values = cursor.number(2);
        const std::size_t begin = cursor.at;
        if (!cursor.skip(name)) return false;
        const Bytes text = bytes.subspan(begin, static_cast<std::size_t>(name));
        if (name > 0 && std::ranges::find(text, std::byte{0}) == text.end()) return false;
        cursor.skip(4 * (version == 1 ? (values + 1) / 2 * 2 : values));
    }
    return cursor.is_sound;
}

/// Before version 3 a size for each dimension, behind 5 bytes of nothing.
bool is_sound_old_layout(const Hdf5Frame& frame, Bytes bytes) {
    constexpr std::uint64_t kCompact = 0, kMost = 33, kKinds = 3;
    Hdf5Cursor cursor{bytes};
    cursor.skip(1);
    const std::uint64_t dimensions = cursor.number(1), kind = cursor.number(1);
    cursor.skip(5 + (kind == kCompact ? 0 : frame.address_bytes));
    cursor.skip(4 * dimensions);
    if (kind == kCompact) skip_sized(cursor);
    return cursor.is_sound && dimensions >= 1 && dimensions <= kMost && kind < kKinds;
}

/// Chunks of version 4, by the kind of their index.
bool are_sound_chunks(const Hdf5Frame& frame, Hdf5Cursor cursor) {
    constexpr std::uint64_t kSingle = 1, kFixed = 3, kGrowing = 4, kTree = 5, kIsFiltered = 2;
    const std::uint64_t flags = cursor.number(1), dimensions = cursor.number(1), width = cursor.number(1);
    cursor.skip(dimensions * width);
    const std::uint64_t index = cursor.number(1);
    if (index == kSingle && (flags & kIsFiltered) != 0) cursor.skip(frame.length_bytes + 4);
    if (index == kFixed) cursor.skip(1);
    if (index == kGrowing) cursor.skip(5);
    if (index == kTree) cursor.skip(6);
    return cursor.skip(frame.address_bytes) && dimensions >= 1 && width >= 1 && width <= 8;
}

bool is_sound_layout(const Hdf5Frame& frame, Bytes bytes) {
    enum : std::uint8_t { compact, contiguous, chunked, from_others };
    Hdf5Cursor cursor{bytes};
    const std::uint64_t version = cursor.number(1);
    if (version < 3) return is_sound_old_layout(frame, bytes);
    switch (cursor.number(1)) {
        case compact: return cursor.skip(cursor.number(2));
        case contiguous: return cursor.skip(frame.address_bytes + frame.length_bytes);
        case chunked:
            if (version >= 4) return are_sound_chunks(frame, cursor);
            return cursor.skip(4 * cursor.number(1) + frame.address_bytes);
        case from_others: return cursor.skip(frame.address_bytes + 4);
        default: return false;
    }
}

/// What of the file is free: heaps for six or twelve kinds of space.
bool is_sound_file_space(const Hdf5Frame& frame, Bytes bytes) {
    Hdf5Cursor cursor{bytes};
    const std::uint64_t version = cursor.number(1);
    cursor.skip(1);
    if (version == 0) return cursor.skip(frame.length_bytes + 6 * frame.address_bytes);
    const bool is_kept = cursor.number(1) != 0;
    return cursor.skip(2 * frame.length_bytes + 2 + (is_kept ? 13 : 1) * frame.address_bytes);
}

bool has_end(Bytes text) { return std::ranges::find(text, std::byte{0}) != text.end(); }

}  // namespace

std::uint64_t hdf5_nowhere(const Hdf5Frame& frame) { return ~std::uint64_t{0} >> (64 - 8 * frame.address_bytes); }

bool is_sound_hdf5_space(const Hdf5Frame& frame, Bytes bytes) {
    Hdf5Cursor cursor{bytes};
    const std::uint64_t version = cursor.number(1), rank = cursor.number(1), flags = cursor.number(1);
    cursor.skip(version == 1 ? 5 : 1);
    cursor.skip(rank * frame.length_bytes * ((flags & 1) != 0 ? 2 : 1));
    return cursor.is_sound && rank <= 32;
}

std::string damage_of_hdf5_message(const Hdf5Frame& frame, Hdf5Message kind, Bytes bytes) {
    const auto unless = [](bool is_sound, const char* damage) { return std::string(is_sound ? "" : damage); };
    const char* const short_one = "a message of its header is too short";
    Hdf5Cursor cursor{bytes};
    switch (kind) {
        case Hdf5Message::space: return unless(is_sound_hdf5_space(frame, bytes), "its dimensions do not fit in its header");
        case Hdf5Message::places_of_links: return unless(are_sound_places(frame, bytes, 8), "the places of its links are damaged");
        case Hdf5Message::places_of_attributes:
            return unless(are_sound_places(frame, bytes, 2), "the places of its attributes are damaged");
        case Hdf5Message::old_fill_value: return unless(skip_sized(cursor), "its fill value does not fit in its header");
        case Hdf5Message::fill_value: return unless(is_sound_fill_value(bytes), "its fill value does not fit in its header");
        case Hdf5Message::link: return unless(is_sound_link(frame, bytes), "a link of the group is damaged");
        case Hdf5Message::external_files: return unless(are_sound_external_files(frame, bytes), "the list of its files is damaged");
        case Hdf5Message::layout: return unless(is_sound_layout(frame, bytes), "where its samples lie does not fit in its header");
        case Hdf5Message::group: return unless(is_sound_group(bytes), short_one);
        case Hdf5Message::filters: return unless(are_sound_filters(bytes), "its filters do not fit in its header");
        case Hdf5Message::comment: return unless(has_end(bytes), "a comment has no end");
        case Hdf5Message::old_time: return unless(has(bytes, 16), short_one);
        case Hdf5Message::heap_table: return unless(has(bytes, 2 + frame.address_bytes), short_one);
        case Hdf5Message::names_of_links: return unless(is_sound_symbol_table(frame, bytes), "the names of its links are damaged");
        case Hdf5Message::time: return unless(has(bytes, 8), short_one);
        case Hdf5Message::sizes_of_trees: return unless(has(bytes, 7), short_one);
        case Hdf5Message::driver: return unless(cursor.skip(9) && cursor.skip(cursor.number(2)), short_one);
        case Hdf5Message::references: return unless(has(bytes, 5), short_one);
        case Hdf5Message::file_space: return unless(is_sound_file_space(frame, bytes), short_one);
        case Hdf5Message::cache_image: return unless(has(bytes, 1 + frame.address_bytes + frame.length_bytes), short_one);
        case Hdf5Message::type:
        case Hdf5Message::attribute:
        case Hdf5Message::continuation: break;
    }
    return {};
}

}  // namespace isoatlas
