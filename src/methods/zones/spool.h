// Spool: items that are added one by one and read in that order. Not in memory where that is limited.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "base/memory_limit.h"
#include "base/part_streams.h"
#include "base/streamed.h"

namespace isoatlas {

template <class T>
class Spool {
public:
    void add(const T& item) {
        last_.push_back(item);
        if (last_.size() == kChunk) store();
    }
    [[nodiscard]] std::size_t size() const { return chunks_.size() * kChunk + last_.size(); }
    template <class Visit>
    void for_each(const Visit& visit) const {
        std::vector<T> buffer;
        for (const std::size_t i : streamed(chunks_.size(), {kChunk * sizeof(T)})) {
            for (const T& item : part_in_memory<T>(chunks_[i], buffer)) visit(item);
        }
        for (const T& item : last_) visit(item);
    }

private:
    static constexpr std::size_t kChunk = kMinScratch / sizeof(T) + 1;  ///< fewer would stay in memory

    void store() {
        write_part<T>(chunks_.emplace_back(last_.size()), last_);
        last_.clear();
    }

    std::vector<Array<T>> chunks_;
    std::vector<T> last_;
};

}  // namespace isoatlas
