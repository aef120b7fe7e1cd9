#include "formats/zarr/zarr_chunks.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "base/check.h"
#include "formats/common/field_reader.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMostShardBytes = std::size_t{32} << 20;
constexpr std::uint64_t kNotStored = std::numeric_limits<std::uint64_t>::max();
constexpr std::int64_t kChecksumBytes = 4;

/// Chunks, or shards, along each axis.
std::vector<std::int64_t> grid_of(const ZarrArray& array) {
    std::vector<std::int64_t> grid;
    const std::vector<std::int64_t>& size = array.shards ? array.shards->size : array.chunk;
    for (std::size_t axis = 0; axis < array.rank(); ++axis) grid.push_back((array.shape[axis] - 1) / size[axis] + 1);
    return grid;
}

}  // namespace

ZarrChunks::ZarrChunks(std::shared_ptr<KeyStore> store, ZarrArray array) : store_(std::move(store)), array_(std::move(array)) {
    most_encoded_ = static_cast<std::size_t>(array_.chunk_bytes());
    for (const ByteCodec& codec : array_.codecs) most_encoded_ = most_encoded(codec, most_encoded_);
    if (!array_.shards) return;
    for (std::size_t axis = 0; axis < array_.rank(); ++axis) per_shard_.push_back(array_.shards->size[axis] / array_.chunk[axis]);
}

const std::vector<std::byte>* ZarrChunks::read(std::span<const std::int64_t> index) {
    ISOATLAS_CHECK(index.size() == array_.rank());
    if (std::ranges::equal(index, index_)) return is_stored_ ? &value_ : nullptr;
    index_.clear();
    const std::string where = array_.key(index);
    try {
        is_stored_ = array_.shards ? fetch_of_shard(index) : fetch(index);
        if (is_stored_) {
            const std::string error = decode_all(array_.codecs, static_cast<std::size_t>(array_.chunk_bytes()), value_, scratch_);
            if (!error.empty()) bad_zarr(*store_, where, "a chunk is damaged: " + error, "a whole chunk");
        }
    } catch (const std::bad_alloc&) {
        throw Error(ErrorKind::resource, {.file = store_->name(),
                                          .where = shown_key(where),
                                          .what = "not enough memory for a chunk of " + std::to_string(array_.chunk_bytes()) + " bytes",
                                          .next = "free some memory, or write the array again in smaller chunks"});
    }
    index_.assign(index.begin(), index.end());
    return is_stored_ ? &value_ : nullptr;
}

bool ZarrChunks::fetch(std::span<const std::int64_t> index) {
    std::optional<std::vector<std::byte>> found = store_->read(array_.key(index), static_cast<std::int64_t>(most_encoded_));
    if (!found) return false;
    value_ = *std::move(found);
    return true;
}

bool ZarrChunks::fetch_of_shard(std::span<const std::int64_t> index) {
    std::vector<std::int64_t> of_shard(index.begin(), index.end());
    std::int64_t number = 0;
    for (std::size_t axis = 0; axis < of_shard.size(); ++axis) {
        number = number * per_shard_[axis] + of_shard[axis] % per_shard_[axis];
        of_shard[axis] /= per_shard_[axis];
    }
    const Shard& found = shard(array_.key(of_shard));
    if (found.bytes == 0) return false;
    const std::uint64_t offset = found.places[2 * static_cast<std::size_t>(number)],
                        bytes = found.places[2 * static_cast<std::size_t>(number) + 1], size = static_cast<std::uint64_t>(found.bytes);
    if (offset == kNotStored && bytes == kNotStored) return false;
    if (offset > size || bytes > size - offset || bytes > most_encoded_)
        bad_zarr(*store_, found.key, "chunk " + std::to_string(number) + " of the shard lies outside of it, or is too long",
                 "a place inside the " + std::to_string(size) + " bytes of the shard");
    value_.resize(static_cast<std::size_t>(bytes));
    store_->read_range(found.key, static_cast<std::int64_t>(offset), value_);
    return true;
}

const ZarrChunks::Shard& ZarrChunks::shard(const std::string& key) {
    const auto found = std::ranges::find(shards_, key, &Shard::key);
    if (found != shards_.end()) {
        shards_.splice(shards_.begin(), shards_, found);
        return shards_.front();
    }
    constexpr std::size_t kMostShards = 1024;
    shards_.push_front(read_shard(key));
    shard_bytes_ += shards_.front().places.size() * sizeof(std::uint64_t);
    while (shards_.size() > 1 && (shard_bytes_ > kMostShardBytes || shards_.size() > kMostShards)) {
        shard_bytes_ -= shards_.back().places.size() * sizeof(std::uint64_t);
        shards_.pop_back();
    }
    return shards_.front();
}

ZarrChunks::Shard ZarrChunks::read_shard(const std::string& key) {
    Shard found{.key = key};
    const std::optional<std::int64_t> size = store_->size(key);
    if (!size) return found;
    std::int64_t chunks = 1;
    for (const std::int64_t count : per_shard_) chunks *= count;
    constexpr std::int64_t kPlaceBytes = 16;
    const std::int64_t list = chunks * kPlaceBytes, index_bytes = list + (array_.shards->index_has_checksum ? kChecksumBytes : 0);
    if (*size < index_bytes)
        bad_zarr(*store_, key, "the shard has " + std::to_string(*size) + " bytes",
                 "at least " + std::to_string(index_bytes) + " for its index");
    std::vector<std::byte> bytes(static_cast<std::size_t>(index_bytes));
    store_->read_range(key, array_.shards->index_at_end ? *size - index_bytes : 0, bytes);
    const std::span<const std::byte> numbers = std::span(bytes).first(static_cast<std::size_t>(list));
    if (array_.shards->index_has_checksum && crc32c(numbers) != FieldReader(bytes, false).at<std::uint32_t>(numbers.size()))
        bad_zarr(*store_, key, "the checksum of the index of the shard is wrong", "a whole shard");
    const FieldReader fields(bytes, array_.shards->index_big_endian);
    found.bytes = *size;
    found.places.resize(numbers.size() / sizeof(std::uint64_t));
    for (std::size_t i = 0; i < found.places.size(); ++i) found.places[i] = fields.at<std::uint64_t>(i * sizeof(std::uint64_t));
    return found;
}

StoredSize stored_size(KeyStore& store, const ZarrArray& array, std::int64_t most_asked) {
    if (const std::optional<std::int64_t> whole = store.bytes()) return {.bytes = *whole, .is_exact = true};
    const std::vector<std::int64_t> grid = grid_of(array);
    constexpr double kMost = 9e18;
    double count = 1;
    for (const std::int64_t along : grid) count *= static_cast<double>(along);
    const std::int64_t asked = count < static_cast<double>(most_asked) ? static_cast<std::int64_t>(count) : most_asked;
    double sum = 0;
    std::vector<std::int64_t> index(grid.size());
    for (std::int64_t i = 0; i < asked; ++i) {
        auto rest = static_cast<std::uint64_t>(std::min(kMost, count / static_cast<double>(asked) * static_cast<double>(i)));
        for (std::size_t axis = grid.size(); axis-- > 0;) {
            index[axis] = static_cast<std::int64_t>(rest % static_cast<std::uint64_t>(grid[axis]));
            rest /= static_cast<std::uint64_t>(grid[axis]);
        }
        sum += static_cast<double>(store.size(array.key(index)).value_or(0));
    }
    const double bytes = asked > 0 ? sum * (count / static_cast<double>(asked)) : 0;
    return {.bytes = static_cast<std::int64_t>(std::min(bytes, kMost)), .is_exact = static_cast<double>(asked) == count};
}

}  // namespace isoatlas
