// The chunks of a Zarr array.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/zarr/key_store.h"
#include "formats/zarr/zarr_array.h"

namespace isoatlas {

/// Not thread safe. Memory: two chunks (encoded and decoded), and at most 32 MiB for the lists of shards, or one list.
class ZarrChunks {
public:
    ZarrChunks(std::shared_ptr<KeyStore> store, ZarrArray array);

    [[nodiscard]] const ZarrArray& array() const { return array_; }
    [[nodiscard]] KeyStore& store() const { return *store_; }
    /// The decoded bytes of a chunk, chunk_bytes() of them, as they are stored: order and byte order of the array. nullptr: the chunk is
    /// not stored, its samples have the fill value. Valid until the next call. index: one number for each axis, inside the array. Throws
    /// Error{input} for what does not decode to a chunk, before it takes memory that the stored bytes cannot stand for.
    [[nodiscard]] const std::vector<std::byte>* read(std::span<const std::int64_t> index);

private:
    /// Where the chunks of one shard lie in it.
    struct Shard {
        std::string key;
        std::int64_t bytes = 0;               ///< of the shard; 0: it is not stored
        std::vector<std::uint64_t> places{};  ///< of each chunk: offset, bytes
    };

    [[nodiscard]] bool fetch(std::span<const std::int64_t> index);
    [[nodiscard]] bool fetch_of_shard(std::span<const std::int64_t> index);
    [[nodiscard]] const Shard& shard(const std::string& key);
    [[nodiscard]] Shard read_shard(const std::string& key);

    std::shared_ptr<KeyStore> store_;
    ZarrArray array_;
    std::size_t most_encoded_ = 0;         ///< bytes of a stored chunk
    std::vector<std::int64_t> per_shard_;  ///< chunks along each axis
    std::list<Shard> shards_;              ///< the one used last is the first
    std::size_t shard_bytes_ = 0;          ///< of their lists
    std::vector<std::int64_t> index_;      ///< of the chunk in value_; empty: none
    bool is_stored_ = false;
    std::vector<std::byte> value_, scratch_;
};

/// Bytes of the array in the store: the sum over its chunks or shards, from at most `most_asked` of them; is_exact: all were asked for.
struct StoredSize {
    std::int64_t bytes = 0;
    bool is_exact = true;
};
[[nodiscard]] StoredSize stored_size(KeyStore& store, const ZarrArray& array, std::int64_t most_asked);

}  // namespace isoatlas
