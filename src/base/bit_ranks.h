// BitRanks: bit vector with rank queries. A set of numbers below a bound; rank(x) = how many of them are smaller than x.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/big_vector.h"
#include "base/memory_limit.h"

namespace isoatlas {

class BitRanks {
public:
    explicit BitRanks(std::size_t bound) {
        const PinInMemory keep;
        words_.assign(bound / kBits + 1, std::uint64_t{0});
    }

    /// Thread safe.
    void add(std::size_t x) {
        const std::atomic_ref<std::uint64_t> word(words_[x / kBits]);
        const std::uint64_t bit = std::uint64_t{1} << x % kBits;
        if ((word.load(std::memory_order_relaxed) & bit) == 0) word.fetch_or(bit, std::memory_order_relaxed);
    }
    [[nodiscard]] bool has(std::size_t x) const { return words_[x / kBits] >> x % kBits & 1; }

    /// Once all are added. Returns how many there are.
    std::size_t count() {
        const PinInMemory keep;
        before_.resize(words_.size());
        std::size_t sum = 0;
        for (std::size_t w = 0; w < words_.size(); ++w) {
            before_[w] = sum;
            sum += static_cast<std::size_t>(std::popcount(words_[w]));
        }
        return sum;
    }
    /// After count().
    [[nodiscard]] std::size_t rank(std::size_t x) const {
        const std::uint64_t smaller = words_[x / kBits] & ((std::uint64_t{1} << x % kBits) - 1);
        return before_[x / kBits] + static_cast<std::size_t>(std::popcount(smaller));
    }

private:
    static constexpr std::size_t kBits = 64;

    BigVector<std::uint64_t> words_;
    BigVector<std::size_t> before_;  // per word: how many lie in the words before
};

}  // namespace isoatlas
