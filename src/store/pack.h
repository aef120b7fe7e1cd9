// Writes a store in one pass: all arrays are known in advance.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/byte_sink.h"
#include "codec/chunk_codec.h"
#include "store/contents.h"

namespace isoatlas {

/// An array to be written. feed calls put until all bytes are written; blocks as in StoredArray.
struct PackedArray {
    std::string name, type;
    std::vector<std::int64_t> shape;
    std::int64_t block = 0;
    std::function<void(const ByteSink& put)> feed;
    std::int64_t chunk = 0;                                     ///< as in StoredArray
    std::function<void(const ByteSink& put)> feed_chunks = {};  ///< instead of feed: calls put with each compressed chunk in order

    [[nodiscard]] std::int64_t bytes() const { return StoredArray{name, type, shape, 0, block, 0, 0, chunk}.bytes(); }
};

inline constexpr std::int64_t kPackedBlock = std::int64_t{1} << 16;

/// An array whose numbers stay in memory until the store is written.
template <class T>
[[nodiscard]] PackedArray packed(std::string name, std::string type, std::span<const T> numbers, std::int64_t block = kPackedBlock) {
    return {std::move(name), std::move(type), {static_cast<std::int64_t>(numbers.size())}, block, [numbers](const ByteSink& put) {
                put(std::as_bytes(numbers));
            }};
}

/// An array of `count` numbers to be compressed; the caller sets its feed. Small arrays are not compressed.
template <class T>
[[nodiscard]] PackedArray packed_chunks(std::string name, std::string type, std::size_t count) {
    constexpr std::size_t kFew = 1024;
    PackedArray array{std::move(name), std::move(type), {static_cast<std::int64_t>(count)}, kPackedBlock, {}};
    if (count < kFew) return array;
    array.chunk = std::min(kChunk, static_cast<std::int64_t>(count));
    array.block = array.chunk * static_cast<std::int64_t>(sizeof(T));
    return array;
}

/// The same for numbers that stay in memory until the store is written.
template <class T>
[[nodiscard]] PackedArray packed_chunks(std::string name, std::string type, std::span<const T> numbers) {
    PackedArray array = packed_chunks<T>(std::move(name), std::move(type), numbers.size());
    array.feed = [numbers](const ByteSink& put) { put(std::as_bytes(numbers)); };
    return array;
}

/// The array with what its feed reads.
[[nodiscard]] inline PackedArray keeping(PackedArray array, std::shared_ptr<const void> numbers) {
    array.feed = [numbers = std::move(numbers), feed = std::move(array.feed)](const ByteSink& put) { feed(put); };
    return array;
}

/// Writes PATH.partial, syncs it and renames it to PATH. contents: volume and parameters; its arrays are filled in.
/// The same bytes for the same arrays. Returns the bytes of the file. Throws Error{resource} with the reason of the system; then no file is
/// left.
std::int64_t pack_store(const std::string& path, Contents contents, const std::vector<PackedArray>& arrays);

}  // namespace isoatlas
