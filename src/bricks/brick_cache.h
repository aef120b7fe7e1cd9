// Which bricks of a store are present, and which have to go: those that were not used for longest, never one that a query holds.
//
// Every brick has its place in memory, of one size, which may share a page with its neighbours'. Pages are counted: a page without a
// present brick is given back to the system. What is budgeted is pages, that is, real memory.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "base/virtual_array.h"

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
    /// array: of `count` bricks of `brick_bytes`. budget: bytes; 0: no limit. All must live as long as this.
    BrickCache(std::int64_t count, std::int64_t brick_bytes, VirtualArray& array, std::int64_t budget, std::mutex& mutex);

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
    /// Pages that a brick touches: first to last.
    [[nodiscard]] std::int64_t first_page(std::int64_t brick) const { return brick * brick_bytes_ / page_bytes_; }
    [[nodiscard]] std::int64_t last_page(std::int64_t brick) const { return ((brick + 1) * brick_bytes_ - 1) / page_bytes_; }
    void add_pages(std::int64_t brick);
    /// Pages that are not used any more, in a row.
    struct PageRange {
        std::int64_t begin = 0, end = 0;
    };
    /// Adds a brick's pages to `unused`, which is given back when others come.
    void drop_pages(std::int64_t brick, PageRange& unused);
    void release(const PageRange& unused);
    void trim();

    std::int64_t brick_bytes_, page_bytes_, budget_;
    VirtualArray& array_;
    std::mutex& mutex_;
    std::vector<std::uint16_t> users_;  ///< per page: how many present bricks touch it
    std::vector<State> state_;
    std::uint64_t now_ = 0;
    std::int64_t pages_ = 0;
};

}  // namespace isoatlas
