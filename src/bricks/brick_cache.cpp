#include "bricks/brick_cache.h"

#include <algorithm>

namespace isoatlas {

void BrickLease::release() {
    if (cache_ == nullptr) return;
    const std::lock_guard lock(cache_->mutex_);
    cache_->end(bricks_);
    cache_ = nullptr;
    bricks_.clear();
}

BrickCache::BrickCache(std::int64_t count, std::int64_t brick_bytes, VirtualArray& array, std::int64_t budget, std::mutex& mutex)
    : brick_bytes_(brick_bytes),
      page_bytes_(static_cast<std::int64_t>(VirtualArray::page_bytes())),
      budget_(budget),
      array_(array),
      mutex_(mutex),
      users_(static_cast<std::size_t>(last_page(count) + 1)),
      state_(static_cast<std::size_t>(count)) {}

void BrickCache::add_pages(std::int64_t brick) {
    for (std::int64_t page = first_page(brick); page <= last_page(brick); ++page) pages_ += users_[static_cast<std::size_t>(page)]++ == 0;
}

void BrickCache::drop_pages(std::int64_t brick, PageRange& unused) {
    for (std::int64_t page = first_page(brick); page <= last_page(brick); ++page) {
        if (--users_[static_cast<std::size_t>(page)] > 0) continue;
        --pages_;
        if (page != unused.end) {
            release(unused);
            unused.begin = page;
        }
        unused.end = page + 1;
    }
}

void BrickCache::release(const PageRange& unused) {
    if (unused.begin == unused.end) return;
    array_.release(static_cast<std::size_t>(unused.begin * page_bytes_),
                   static_cast<std::size_t>((unused.end - unused.begin) * page_bytes_));
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
    PageRange unused;
    for (const std::int64_t b : bricks) drop_pages(b, unused);
    release(unused);
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
    // For equal age the last one first, because neighbours share pages.
    std::sort(idle.begin(), idle.end(), [this](std::int64_t p, std::int64_t q) {
        const std::uint64_t p_used = state_[static_cast<std::size_t>(p)].used, q_used = state_[static_cast<std::size_t>(q)].used;
        return p_used != q_used ? p_used < q_used : p > q;
    });
    PageRange unused;
    for (const std::int64_t b : idle) {
        if (bytes() <= budget_) break;
        state_[static_cast<std::size_t>(b)].present = false;
        drop_pages(b, unused);
    }
    release(unused);
}

void BrickCache::clear() {
    PageRange unused;
    for (std::size_t b = 0; b < state_.size(); ++b) {
        if (!state_[b].present || state_[b].leases > 0) continue;
        state_[b].present = false;
        drop_pages(static_cast<std::int64_t>(b), unused);
    }
    release(unused);
}

}  // namespace isoatlas
