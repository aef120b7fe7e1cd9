// Reading bricks of a store: few, long reads; every brick checked before it is used.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "field/brick_grid.h"
#include "store/container.h"

namespace isoatlas {

/// What reading has cost.
struct IoCounters {
    std::int64_t bytes = 0, extents = 0, bricks = 0;
    std::int64_t samples = 0;  ///< of the bricks
    IoCounters& operator+=(const IoCounters& other) {
        bytes += other.bytes, extents += other.extents, bricks += other.bricks, samples += other.samples;
        return *this;
    }
};

template <class T>
class BrickReader {
public:
    /// Reads what there is about every brick: 22 bytes and two samples each. Throws Error{input} when it contradicts itself.
    explicit BrickReader(const Container& store);

    [[nodiscard]] const BrickGrid& grid() const { return grid_; }
    [[nodiscard]] T low(std::int64_t brick) const { return low_[static_cast<std::size_t>(brick)]; }
    [[nodiscard]] T high(std::int64_t brick) const { return high_[static_cast<std::size_t>(brick)]; }

    /// What read() of a list costs.
    [[nodiscard]] IoCounters cost_of(std::vector<std::int64_t> bricks) const;
    /// The most that read() of a part of the list costs.
    [[nodiscard]] IoCounters max_of_part(std::vector<std::int64_t> bricks) const;
    /// Voxels of the highest and the lowest sample of a brick; ties as in the total order (field/order.h).
    [[nodiscard]] std::int64_t highest_voxel(std::int64_t brick) const {
        return voxel_at(brick, highest_[static_cast<std::size_t>(brick)]);
    }
    [[nodiscard]] std::int64_t lowest_voxel(std::int64_t brick) const { return voxel_at(brick, lowest_[static_cast<std::size_t>(brick)]); }

    /// Calls sink(brick, samples of its box, x fastest) for every brick of the list, from several threads, in no order. Bricks that lie
    /// close to each other in the file come with one read. Throws Error: input (a damaged one, or one whose extremes are not where they
    /// are said to be), cancelled.
    IoCounters read(std::vector<std::int64_t> bricks, const Context& context,
                    const std::function<void(std::int64_t, std::span<const T>)>& sink) const;
    /// The same into the whole volume, x fastest: every sample where it belongs.
    IoCounters read_into(T* whole, std::vector<std::int64_t> bricks, const Context& context) const;
    /// All samples. whole.size(): the voxels of the volume.
    IoCounters read_all(std::span<T> whole, const Context& context) const;
    /// Reads all bricks; throws Error{input} where the places of the extremes are not those of the samples.
    void check(const Context& context) const;

private:
    struct Extent {
        std::size_t first, last;  ///< of the list
        std::int64_t begin, end;  ///< bytes in volume/data
    };
    /// Which extents has the disk been asked for?
    using Prefetched = std::vector<std::atomic<bool>>;
    /// A read has to wait: asks for its bytes and those of the next ones.
    void prefetch(std::span<const Extent> extents, std::size_t first, Prefetched& prefetched) const;
    [[nodiscard]] std::int64_t bytes_of(std::int64_t brick) const { return bytes_[static_cast<std::size_t>(brick)]; }
    void check_places() const;
    [[nodiscard]] std::vector<std::int64_t> all_bricks() const;
    void sort_by_offset(std::vector<std::int64_t>& bricks) const;
    [[nodiscard]] IoCounters count(std::span<const std::int64_t> bricks, std::span<const Extent> extents) const;
    [[nodiscard]] std::vector<Extent> extents_of(std::span<const std::int64_t> bricks, std::int64_t longest) const;
    [[nodiscard]] std::int64_t voxel_at(std::int64_t brick, std::int64_t place) const;
    void decode(std::int64_t brick, std::span<const std::byte> packed,
                const std::function<void(std::int64_t, std::span<const T>)>& sink) const;

    const Container& store_;
    const StoredArray& data_;
    BrickGrid grid_;
    std::vector<std::uint64_t> offset_, sums_;
    std::vector<std::uint16_t> bytes_;
    std::vector<T> low_, high_;
    std::vector<std::uint16_t> lowest_, highest_;
};

}  // namespace isoatlas
