#include "query/brick_cache.h"

#include <algorithm>

namespace isoatlas {

using store::Box;

void BrickLease::release() {
    if (cache_ == nullptr) return;
    const std::lock_guard lock(cache_->mutex_);
    cache_->end(bricks_);
    cache_ = nullptr;
    bricks_.clear();
}

BrickCache::BrickCache(const store::BrickGrid& grid, std::size_t sample_bytes, VirtualArray& array, std::int64_t budget, std::mutex& mutex)
    : grid_(grid),
      sample_bytes_(static_cast<std::int64_t>(sample_bytes)),
      page_bytes_(static_cast<std::int64_t>(VirtualArray::page_bytes())),
      budget_(budget),
      array_(array),
      mutex_(mutex),
      users_(static_cast<std::size_t>(2 * (grid.extent.voxels() * sample_bytes_ / page_bytes_ + 1))),
      state_(static_cast<std::size_t>(grid.count())) {}

template <class Visit>
void BrickCache::for_pages(std::int64_t brick, Visit&& visit) const {
    const Box box = grid_.box(brick);
    std::int64_t next = 0;  // pages before it have been visited
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
            const std::int64_t first = grid_.extent.index(box.begin[0], y, z) * sample_bytes_;
            const std::int64_t last = first + box.size(0) * sample_bytes_ - 1;
            for (next = std::max(next, first / page_bytes_); next <= last / page_bytes_; ++next) visit(next);
        }
    }
}

void BrickCache::add_pages(std::int64_t brick) {
    auto* users = reinterpret_cast<std::uint16_t*>(users_.data());
    for_pages(brick, [&](std::int64_t page) { pages_ += users[page]++ == 0; });
}

void BrickCache::drop_pages(std::int64_t brick) {
    auto* users = reinterpret_cast<std::uint16_t*>(users_.data());
    std::int64_t begin = 0, end = 0;  // pages in a row that nobody uses any more
    const auto give_back = [&] {
        if (begin < end)
            array_.give_back(static_cast<std::size_t>(begin * page_bytes_), static_cast<std::size_t>((end - begin) * page_bytes_));
    };
    for_pages(brick, [&](std::int64_t page) {
        if (--users[page] > 0) return;
        --pages_;
        if (page != end) {
            give_back();
            begin = page;
        }
        end = page + 1;
    });
    give_back();
}

std::vector<std::int64_t> BrickCache::admit(std::span<const std::int64_t> bricks, BrickLease& lease) {
    std::vector<std::int64_t> missing;
    lease.cache_ = this;
    lease.bricks_.insert(lease.bricks_.end(), bricks.begin(), bricks.end());
    ++now_;
    for (const std::int64_t b : bricks) {
        State& state = state_[static_cast<std::size_t>(b)];
        state.used = now_;
        ++state.leases;
        if (state.present) continue;
        add_pages(b);
        missing.push_back(b);
    }
    trim();
    return missing;
}

void BrickCache::settle(std::span<const std::int64_t> bricks) {
    for (const std::int64_t b : bricks) state_[static_cast<std::size_t>(b)].present = true;
}

void BrickCache::abandon(std::span<const std::int64_t> bricks) {
    for (const std::int64_t b : bricks) drop_pages(b);
}

void BrickCache::end(std::span<const std::int64_t> bricks) {
    for (const std::int64_t b : bricks) --state_[static_cast<std::size_t>(b)].leases;
    trim();
}

void BrickCache::trim() {
    if (budget_ <= 0 || bytes() <= budget_) return;
    std::vector<std::int64_t> idle;
    for (std::size_t b = 0; b < state_.size(); ++b) {
        if (state_[b].present && state_[b].leases == 0) idle.push_back(static_cast<std::int64_t>(b));
    }
    // Of the same age the last first: neighbours share pages.
    std::sort(idle.begin(), idle.end(), [this](std::int64_t p, std::int64_t q) {
        const std::uint64_t p_used = state_[static_cast<std::size_t>(p)].used, q_used = state_[static_cast<std::size_t>(q)].used;
        return p_used != q_used ? p_used < q_used : p > q;
    });
    for (const std::int64_t b : idle) {
        if (bytes() <= budget_) break;
        state_[static_cast<std::size_t>(b)].present = false;
        drop_pages(b);
    }
}

void BrickCache::clear() {
    for (std::size_t b = 0; b < state_.size(); ++b) {
        if (!state_[b].present || state_[b].leases > 0) continue;
        state_[b].present = false;
        drop_pages(static_cast<std::int64_t>(b));
    }
}

}  // namespace isoatlas
