// Reads bricks of a store with few, long reads; every brick is checked before use.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "field/brick_grid.h"
#include "store/container.h"
#include "store/io_counters.h"

namespace isoatlas {

template <class T>
class BrickReader {
public:
    /// Reads the index of bricks: 22 bytes and two samples each. Throws Error{input} when it is inconsistent.
    explicit BrickReader(const Container& store);

    [[nodiscard]] const BrickGrid& grid() const { return grid_; }
    /// Of the samples as they come out: negated ones when the store is open for objects of low values.
    [[nodiscard]] T low(BrickId brick) const { return low_[brick.index()]; }
    [[nodiscard]] T high(BrickId brick) const { return high_[brick.index()]; }

    /// Cost of read() of a list.
    [[nodiscard]] IoCounters cost_of(std::vector<BrickId> bricks) const;
    /// Upper bound of the cost of read() of a part of the list.
    [[nodiscard]] IoCounters max_of_part(std::vector<BrickId> bricks) const;
    /// Voxels of the highest and the lowest sample of a brick; ties as in the total order (field/order.h).
    [[nodiscard]] VoxelId highest_voxel(BrickId brick) const { return voxel_at(brick, highest_[brick.index()]); }
    [[nodiscard]] VoxelId lowest_voxel(BrickId brick) const { return voxel_at(brick, lowest_[brick.index()]); }

    /// Calls sink(brick, samples of its box, x fastest) for every brick of the list, from several threads, in no order. Bricks that are
    /// close to each other in the file share one read. Throws Error: input (a damaged brick, or extremes not at their stored positions),
    /// cancelled.
    IoCounters read(std::vector<BrickId> bricks, const Context& context,
                    const std::function<void(BrickId, std::span<const T>)>& sink) const;
    /// The same into the whole volume, x fastest, at the positions of the samples.
    IoCounters read_into(T* whole, std::vector<BrickId> bricks, const Context& context) const;
    /// All samples. whole.size(): the voxels of the volume.
    IoCounters read_all(std::span<T> whole, const Context& context) const;
    /// Reads all bricks; throws Error{input} where the positions of the extremes are wrong.
    void check(const Context& context) const;

private:
    struct Extent {
        std::size_t first, last;  ///< of the list
        std::int64_t begin, end;  ///< bytes in volume/data
    };
    /// Extents that have been prefetched.
    using Prefetched = std::vector<std::atomic<bool>>;
    /// On a blocking read: prefetches its bytes and those of the next ones.
    void prefetch(std::span<const Extent> extents, std::size_t first, Prefetched& prefetched) const;
    [[nodiscard]] std::int64_t bytes_of(BrickId brick) const { return bytes_[brick.index()]; }
    void check_places() const;
    [[nodiscard]] std::vector<BrickId> all_bricks() const;
    void sort_by_offset(std::vector<BrickId>& bricks) const;
    [[nodiscard]] IoCounters count(std::span<const BrickId> bricks, std::span<const Extent> extents) const;
    [[nodiscard]] std::vector<Extent> extents_of(std::span<const BrickId> bricks, std::int64_t longest) const;
    [[nodiscard]] VoxelId voxel_at(BrickId brick, std::int64_t place) const;
    void decode(BrickId brick, std::span<const std::byte> packed, const std::function<void(BrickId, std::span<const T>)>& sink) const;

    const Container& store_;
    const StoredArray& data_;
    bool is_negated_;
    BrickGrid grid_;
    std::vector<std::uint64_t> offset_, sums_;
    std::vector<std::uint16_t> bytes_;
    std::vector<T> low_, high_;
    std::vector<std::uint16_t> lowest_, highest_;
};

/// The first byte of each brick, which says how it is coded; 0 of one that has no bytes. Cost: reads all bricks.
[[nodiscard]] std::vector<std::uint8_t> brick_heads(const Container& store);

}  // namespace isoatlas
