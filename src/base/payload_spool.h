// PayloadSpool: strings of bytes in their order, not in memory where that is limited.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/budget_poll.h"
#include "isoatlas/array.h"

namespace isoatlas {

class PayloadSpool {
public:
    void add(std::span<const std::byte> payload) {
        constexpr std::size_t kChunk = std::size_t{1} << 22;
        if (chunks_.empty() || chunks_.back().size() + payload.size() > kChunk) {
            chunks_.emplace_back().reserve(kChunk);
            sizes_.emplace_back();
        }
        chunks_.back().insert(chunks_.back().end(), payload.begin(), payload.end());
        sizes_.back().push_back(payload.size());
        memory_.step(payload.size());
    }

    /// Calls use(payload) for all, in their order.
    template <class Use>
    void for_each(const Use& use) const {
        for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
            std::size_t at = 0;
            for (const std::size_t size : sizes_[chunk]) use(std::span(chunks_[chunk]).subspan(std::exchange(at, at + size), size));
            (void)check_memory();
        }
    }

private:
    std::vector<Array<std::byte>> chunks_;
    std::vector<std::vector<std::size_t>> sizes_;
    BudgetPoll memory_;
};

}  // namespace isoatlas
