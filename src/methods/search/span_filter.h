// Span filter (section 3.8.1): the range of values is cut into buckets; a cell is listed under the bucket of its lowest sample and the
// number of buckets that it spans. A query looks at the lists that reach the bucket of the isovalue. In the literature: Gallagher, Span
// filtering, 1991. Buckets hold about as many lowest samples each; theirs were chosen by hand.
#pragma once

#include "methods/search/cell_grid.h"

namespace isoatlas {

template <class T>
class SpanFilter final : public CellSearch {
public:
    explicit SpanFilter(const CellGrid<T>& grid) {
        const std::vector<CellInterval<T>> cells = cell_intervals(grid);
        cut_range(cells);
        const std::size_t buckets = begins_.size();
        std::vector<std::size_t> list(cells.size());
        lists_.assign(buckets * buckets + 1, 0);
        for (std::size_t i = 0; i < cells.size(); ++i)
            ++lists_[(list[i] = bucket_of(static_cast<double>(cells[i].low)) * buckets + bucket_of(static_cast<double>(cells[i].high))) +
                     1];
        for (std::size_t i = 1; i < lists_.size(); ++i) lists_[i] += lists_[i - 1];
        std::vector<std::size_t> next(lists_.begin(), lists_.end() - 1);
        cells_.resize(cells.size());
        for (std::size_t i = 0; i < cells.size(); ++i) cells_[next[list[i]]++] = cells[i];
    }

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        const std::size_t buckets = begins_.size(), at = bucket_of(tau);
        for (std::size_t from = 0; from <= at && from < buckets; ++from) {
            ++cost.nodes;
            // Lists of one first bucket lie one after the other, by span.
            for (std::size_t i = lists_[from * buckets + at]; i < lists_[(from + 1) * buckets]; ++i) {
                ++cost.cells;
                if (cells_[i].is_active(tau)) found.push_back(cells_[i].cell);
            }
        }
        cost.active = std::ssize(found);
        return found;
    }
    std::int64_t bytes() const override { return bytes_of(cells_) + bytes_of(lists_) + bytes_of(begins_); }

private:
    static constexpr std::size_t kBuckets = 64;

    void cut_range(const std::vector<CellInterval<T>>& cells) {
        std::vector<T> lows;
        for (const CellInterval<T>& c : cells) lows.push_back(c.low);
        std::ranges::sort(lows);
        for (std::size_t b = 0; b < kBuckets && !lows.empty(); ++b) begins_.push_back(lows[b * lows.size() / kBuckets]);
        begins_.erase(std::unique(begins_.begin(), begins_.end()), begins_.end());
    }

    /// The last bucket that begins at or below a value; the first one holds everything below it too.
    [[nodiscard]] std::size_t bucket_of(double value) const {
        const auto above = std::ranges::upper_bound(begins_, value, {}, [](T begin) { return static_cast<double>(begin); });
        return above == begins_.begin() ? 0 : static_cast<std::size_t>(above - begins_.begin()) - 1;
    }

    std::vector<CellInterval<T>> cells_;  ///< by first bucket, then by last bucket
    std::vector<T> begins_;               ///< ascending
    std::vector<std::size_t> lists_;      ///< where the cells of a first and a last bucket begin
};

}  // namespace isoatlas
