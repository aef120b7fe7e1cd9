// LRU cache of the bricks of a store; bricks leased by a query are not evicted.
//
// Every brick has a slot of fixed size in virtual memory, which may share pages with its neighbours. Pages are reference counted: a page
// without a present brick is released to the system. The budget counts pages, i.e. resident memory.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "base/virtual_array.h"
#include "field/brick_grid.h"

namespace isoatlas {

class BrickCache;

/// Lease: its bricks stay present during its lifetime.
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
    std::vector<BrickId> bricks_;
};

/// Not thread safe except for the end of leases: the owner's mutex guards every call and is locked when a lease ends.
class BrickCache {
public:
    /// array: of `count` bricks of `brick_bytes`. budget: bytes; 0: no limit. All must live as long as this.
    BrickCache(std::int64_t count, std::int64_t brick_bytes, VirtualArray& array, std::int64_t budget, std::mutex& mutex);

    /// Allocates and leases bricks, and returns those that are not present: the caller fills them, then calls settle(), or abandon() on
    /// failure. Unleased bricks are evicted when the budget is exceeded; leased ones may exceed it.
    [[nodiscard]] std::vector<BrickId> admit(std::span<const BrickId> bricks, BrickLease& lease);
    void settle(std::span<const BrickId> bricks);
    void abandon(std::span<const BrickId> bricks);

    /// Evicts all unleased bricks.
    void clear();
    /// Memory of the present bricks.
    [[nodiscard]] std::int64_t bytes() const { return pages_ * page_bytes_; }

private:
    friend class BrickLease;
    struct State {
        std::uint64_t used = 0;  ///< time of the last use
        std::uint32_t leases = 0;
        bool present = false;
    };
    void end(std::span<const BrickId> bricks);
    /// Pages of a brick: first to last.
    [[nodiscard]] std::int64_t first_page(BrickId brick) const { return brick.number() * brick_bytes_ / page_bytes_; }
    [[nodiscard]] std::int64_t last_page(BrickId brick) const { return ((brick.number() + 1) * brick_bytes_ - 1) / page_bytes_; }
    void add_pages(BrickId brick);
    /// A run of unused pages.
    struct PageRange {
        std::int64_t begin = 0, end = 0;
    };
    /// Adds the pages of a brick to `unused`, which is released when it is not contiguous with them.
    void drop_pages(BrickId brick, PageRange& unused);
    void release(const PageRange& unused);
    void trim();

    std::int64_t brick_bytes_, page_bytes_, budget_;
    VirtualArray& array_;
    std::mutex& mutex_;
    std::vector<std::uint16_t> users_;  ///< per page: number of present bricks on it
    IdArray<BrickId, State> state_;
    std::uint64_t now_ = 0;
    std::int64_t pages_ = 0;
};

}  // namespace isoatlas
