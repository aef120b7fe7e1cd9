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

/// Numbers one after another into blocks: a PayloadWriter of any length.
class StreamWriter {
public:
    explicit StreamWriter(BlockWriter& file) : file_(file), place_{file.blocks(), 0} {}
    template <class T>
    void put(T value) {
        std::span<const std::byte> bytes = std::as_bytes(std::span(&value, 1));
        place_.bytes += std::ssize(bytes);
        for (const auto in_block = static_cast<std::size_t>(file_.payload_bytes()); !bytes.empty();) {
            const auto some = bytes.first(std::min(bytes.size(), in_block - block_.size()));
            block_.insert(block_.end(), some.begin(), some.end());
            bytes = bytes.subspan(some.size());
            if (block_.size() == in_block) flush();
        }
    }
    /// After the last number.
    [[nodiscard]] StreamPlace finish() {
        if (!block_.empty()) flush();
        return place_;
    }

private:
    void flush() {
        (void)file_.add(block_);
        block_.clear();
    }

    BlockWriter& file_;
    StreamPlace place_;
    std::vector<std::byte> block_;
};

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
void put_array(StreamWriter& stream, const Array& array) {
    stream.put(static_cast<std::int64_t>(array.size()));
    for (const auto& item : array) stream.put(item);
}
template <class Array>
void get_array(PayloadReader& payload, const BlockReader& file, Array& array) {
    const auto count = payload.get<std::int64_t>();
    if (count < 0 || count > file.blocks() * file.block_bytes()) file.fail("a table is longer than the file");
    array.clear();
    for (std::int64_t i = 0; i < count; ++i) array.push_back(payload.get<typename Array::value_type>());
}

}  // namespace isoatlas
