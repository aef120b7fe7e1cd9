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
      users_(static_cast<std::size_t>(last_page(BrickId(count)) + 1)),
      state_(static_cast<std::size_t>(count)) {}

void BrickCache::add_pages(BrickId brick) {
    for (std::int64_t page = first_page(brick); page <= last_page(brick); ++page) pages_ += users_[static_cast<std::size_t>(page)]++ == 0;
}

void BrickCache::drop_pages(BrickId brick, PageRange& unused) {
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

std::vector<BrickId> BrickCache::admit(std::span<const BrickId> bricks, BrickLease& lease) {
    std::vector<BrickId> missing;
    lease.cache_ = this;
    lease.bricks_.insert(lease.bricks_.end(), bricks.begin(), bricks.end());
    ++now_;
    for (const BrickId b : bricks) {
        State& state = state_[b];
        state.used = now_;
        ++state.leases;
        if (state.present) continue;
        add_pages(b);
        missing.push_back(b);
    }
    trim();
    return missing;
}

void BrickCache::settle(std::span<const BrickId> bricks) {
    for (const BrickId b : bricks) state_[b].present = true;
}

void BrickCache::abandon(std::span<const BrickId> bricks) {
    PageRange unused;
    for (const BrickId b : bricks) drop_pages(b, unused);
    release(unused);
}

void BrickCache::end(std::span<const BrickId> bricks) {
    for (const BrickId b : bricks) --state_[b].leases;
    trim();
}

void BrickCache::trim() {
    if (budget_ <= 0 || bytes() <= budget_) return;
    std::vector<BrickId> idle;
    for (const BrickId b : state_.ids()) {
        if (state_[b].present && state_[b].leases == 0) idle.push_back(b);
    }
    // For equal age the last one first, because neighbours share pages.
    std::sort(idle.begin(), idle.end(), [this](BrickId p, BrickId q) {
        const std::uint64_t p_used = state_[p].used, q_used = state_[q].used;
        return p_used != q_used ? p_used < q_used : p > q;
    });
    PageRange unused;
    for (const BrickId b : idle) {
        if (bytes() <= budget_) break;
        state_[b].present = false;
        drop_pages(b, unused);
    }
    release(unused);
}

void BrickCache::clear() {
    PageRange unused;
    for (const BrickId b : state_.ids()) {
        if (!state_[b].present || state_[b].leases > 0) continue;
        state_[b].present = false;
        drop_pages(b, unused);
    }
    release(unused);
}

}  // namespace isoatlas
