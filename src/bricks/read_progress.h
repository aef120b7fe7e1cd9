// How far a read of many bricks is: on a slow disk or a server it takes longer than all that follows.
#pragma once

#include <atomic>
#include <cstddef>

#include "base/cancel.h"
#include "base/phase.h"

namespace isoatlas {

/// Counts bricks as they come, on any thread; the one that made it reports. context: outlives this.
class ReadProgress {
public:
    ReadProgress(const Context& context, std::size_t bricks) : context_(context), caller_(context), bricks_(bricks) {
        if (bricks > kStep) report(context, kPhase, 0);
    }
    void add() {
        const std::size_t done = done_.fetch_add(1, std::memory_order_relaxed) + 1;
        if (done % kStep == 0 && caller_.is_caller()) report(context_, kPhase, static_cast<double>(done) / static_cast<double>(bricks_));
    }

private:
    static constexpr std::size_t kStep = 16;
    static constexpr Phase kPhase = only_phase("read");
    const Context& context_;
    CallerLooks caller_;
    std::size_t bricks_;
    std::atomic<std::size_t> done_ = 0;
};

}  // namespace isoatlas
