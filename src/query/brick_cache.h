// Which bricks of a store are present, and which have to go: those that were not used for longest, never one that a query holds.
//
// Samples lie where they would lie in the whole volume, so one page of memory belongs to several bricks. Pages are counted: a page without
// a present brick is given back to the system. What is budgeted is pages, that is, real memory.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "base/virtual_array.h"
#include "store/brick_grid.h"

namespace isoatlas {

class BrickCache;

/// Bricks that stay present as long as this lives.
class BrickLease {
public:
    BrickLease() = default;
    BrickLease(const BrickLease&) = delete;
    BrickLease& operator=(const BrickLease&) = delete;
    ~BrickLease() { release(); }
    void release();

private:
    friend class BrickCache;
    BrickCache* cache_ = nullptr;
    std::vector<std::int64_t> bricks_;
};

/// Not thread safe but for the end of leases: the owner's mutex guards every call and is taken when a lease ends.
class BrickCache {
public:
    /// array: of all samples. budget: bytes; 0: no limit. All must live as long as this.
    BrickCache(const store::BrickGrid& grid, std::size_t sample_bytes, VirtualArray& array, std::int64_t budget, std::mutex& mutex);

    /// Makes room for bricks, holds them, and returns those that are not present: the caller fills them, then calls settle(), or
    /// abandon() when that failed. A brick that no lease holds goes first when the budget is short; held ones may exceed it.
    [[nodiscard]] std::vector<std::int64_t> admit(std::span<const std::int64_t> bricks, BrickLease& lease);
    void settle(std::span<const std::int64_t> bricks);
    void abandon(std::span<const std::int64_t> bricks);

    /// Drops all bricks that no lease holds.
    void clear();
    /// Memory of the present bricks.
    [[nodiscard]] std::int64_t bytes() const { return pages_ * page_bytes_; }

private:
    friend class BrickLease;
    struct State {
        std::uint64_t used = 0;  ///< when
        std::uint32_t leases = 0;
        bool present = false;
    };
    void end(std::span<const std::int64_t> bricks);
    /// Calls visit(page) once for every page that a brick touches, ascending.
    template <class Visit>
    void for_pages(std::int64_t brick, Visit&& visit) const;
    void add_pages(std::int64_t brick);
    void drop_pages(std::int64_t brick);
    void trim();

    const store::BrickGrid& grid_;
    std::int64_t sample_bytes_, page_bytes_, budget_;
    VirtualArray& array_;
    std::mutex& mutex_;
    VirtualArray users_;  ///< per page: how many present bricks touch it, 16 bits
    std::vector<State> state_;
    std::uint64_t now_ = 0;
    std::int64_t pages_ = 0;
};

}  // namespace isoatlas
