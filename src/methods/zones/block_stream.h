// Bytes of any number, one after another through blocks: for tables that are read as a whole.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "methods/disk/block_file.h"

namespace isoatlas {

/// Where a stream is. Its blocks follow each other.
struct StreamPlace {
    std::int64_t first = 0, bytes = 0;
};

/// Adds the blocks.
inline StreamPlace write_stream(BlockWriter& file, std::span<const std::byte> bytes) {
    const auto in_block = static_cast<std::size_t>(file.payload_bytes());
    StreamPlace place{0, static_cast<std::int64_t>(bytes.size())};
    for (std::size_t at = 0; at < bytes.size(); at += in_block) {
        const std::int64_t block = file.add(bytes.subspan(at, std::min(in_block, bytes.size() - at)));
        if (at == 0) place.first = block;
    }
    return place;
}

/// Throws Error{input}: it lies outside of the file, damaged.
inline std::vector<std::byte> read_stream(const BlockReader& file, const StreamPlace& place) {
    if (place.first < 0 || place.bytes < 0 || place.bytes > file.blocks() * file.payload_bytes())
        file.fail("a table lies outside of the file");
    std::vector<std::byte> bytes;
    for (std::int64_t block = place.first; static_cast<std::int64_t>(bytes.size()) < place.bytes; ++block) {
        const std::vector<std::byte> part = file.read(block);
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    bytes.resize(static_cast<std::size_t>(place.bytes));
    return bytes;
}

/// Texts and arrays: their length, then what they hold.
template <class Array>
void put_array(PayloadWriter& payload, const Array& array) {
    payload.put(static_cast<std::int64_t>(array.size()));
    for (const auto& item : array) payload.put(item);
}
template <class Array>
void get_array(PayloadReader& payload, const BlockReader& file, Array& array) {
    const auto count = payload.get<std::int64_t>();
    if (count < 0 || count > file.blocks() * file.block_bytes()) file.fail("a table is longer than the file");
    array.clear();
    for (std::int64_t i = 0; i < count; ++i) array.push_back(payload.get<typename Array::value_type>());
}

}  // namespace isoatlas
