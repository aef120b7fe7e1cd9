// Systematic sampling of many items by weight: one for each equal part of all weights, in their order.
// In the literature: systematic sampling (Madow and Madow, On the theory of systematic sampling, 1944).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace isoatlas {

/// weight(i): of an item, 0 or more; called twice. The same choice for any number of threads.
template <class Weight>
class SystematicSample {
public:
    SystematicSample(std::int64_t items, int threads, Weight weight)
        : items_(items),
          pieces_((items + kPiece - 1) / kPiece),
          threads_(threads),
          weight_(std::move(weight)),
          before_(pieces_ + std::int64_t{1}) {
        for_each_block(threads_, pieces_, [&](std::int64_t piece) {
            double sum = 0;
            for (std::int64_t i = piece * kPiece; i < end_of(piece); ++i) sum += weight_(i);
            before_[piece + 1] = sum;
        });
        for (std::int64_t piece = 0; piece < pieces_; ++piece) before_[piece + 1] += before_[piece];
    }

    [[nodiscard]] double total() const { return before_.back(); }
    /// How many parts of this weight have their middle in the items; at most the total by the part, rounded.
    [[nodiscard]] std::int64_t count(double part) const { return parts_before(total(), part); }
    /// visit(i, k): the middle of part k lies in item i, k < count(part); on all threads.
    template <class Visit>
    void for_each(double part, const Visit& visit) const {
        for_each_block(threads_, pieces_, [&](std::int64_t piece) {
            double sum = 0;  // as above: a piece ends where the next one begins
            std::int64_t next = parts_before(before_[piece], part);
            const std::int64_t end = parts_before(before_[piece + 1], part);
            for (std::int64_t i = piece * kPiece; i < end_of(piece) && next < end; ++i) {
                sum += weight_(i);
                for (; next < end && middle(next, part) < before_[piece] + sum; ++next) visit(i, next);
            }
        });
    }

private:
    static constexpr std::int64_t kPiece = 4096;

    [[nodiscard]] static double middle(std::int64_t k, double part) { return (static_cast<double>(k) + 0.5) * part; }
    /// How many of the parts have their middle before this sum.
    [[nodiscard]] static std::int64_t parts_before(double sum, double part) {
        std::int64_t count = std::max(static_cast<std::int64_t>(sum / part) - 1, std::int64_t{0});
        while (middle(count, part) < sum) ++count;
        return count;
    }
    [[nodiscard]] std::int64_t end_of(std::int64_t piece) const { return std::min((piece + 1) * kPiece, items_); }

    std::int64_t items_, pieces_;
    int threads_;
    Weight weight_;
    std::vector<double> before_;  ///< each piece
};

}  // namespace isoatlas
