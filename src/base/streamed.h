// Loops over large arrays that keep the memory budget: the numbers or ids of a range, in order, with a look at the budget on the way.
#pragma once

#include <cstddef>

#include "base/memory_limit.h"

namespace isoatlas {

/// Bytes that a step of a loop may bring into memory, on average.
struct StepBytes {
    std::size_t bytes;
};
/// The step reads or writes so many arrays in order, 8 bytes of each.
constexpr StepBytes in_order(std::size_t arrays) { return {8 * arrays}; }
/// The step accesses so many arrays at random: the system maps 16 pages at a touch.
constexpr StepBytes at_random(std::size_t arrays = 1) { return {arrays * BudgetPoll::kTouch}; }

/// for (const ElementId e : streamed<ElementId>(n, at_random(2))): the ids 0 .. n - 1. The budget is that in force (base/memory_limit.h).
/// down: n - 1 .. 0. Cost: a subtraction a step where no limit is in force.
template <class I = std::size_t>
class Streamed {
public:
    class End {};
    class Iterator {
    public:
        Iterator(std::size_t count, StepBytes step, bool down) : count_(count), step_(step), down_(down) {}
        [[nodiscard]] I operator*() const { return I(down_ ? count_ - 1 - at_ : at_); }
        Iterator& operator++() {
            ++at_;
            poll_.step(step_.bytes);
            return *this;
        }
        [[nodiscard]] friend bool operator==(const Iterator& at, End) { return at.at_ == at.count_; }

    private:
        std::size_t at_ = 0, count_;
        StepBytes step_;
        bool down_;
        BudgetPoll poll_;
    };
    Streamed(std::size_t count, StepBytes step, bool down) : count_(count), step_(step), down_(down) {}
    [[nodiscard]] Iterator begin() const { return Iterator(count_, step_, down_); }
    [[nodiscard]] End end() const { return {}; }

private:
    std::size_t count_;
    StepBytes step_;
    bool down_;
};

template <class I = std::size_t>
[[nodiscard]] Streamed<I> streamed(std::size_t count, StepBytes step) {
    return {count, step, false};
}
template <class I = std::size_t>
[[nodiscard]] Streamed<I> streamed_down(std::size_t count, StepBytes step) {
    return {count, step, true};
}

}  // namespace isoatlas
