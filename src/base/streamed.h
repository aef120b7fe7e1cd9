// Loops over large arrays that keep the memory budget: the numbers or ids of a range, in order, with a look at the budget on the way.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/budget_poll.h"

namespace isoatlas {

/// Bytes that a step of a loop may bring into memory, on average.
struct StepBytes {
    std::size_t bytes;
};
/// The step reads or writes so many arrays in order, 8 bytes of each.
constexpr StepBytes in_order(std::size_t arrays) { return {8 * arrays}; }
/// The step accesses so many arrays at random: the system maps 16 pages at a touch.
constexpr StepBytes at_random(std::size_t arrays = 1) { return {arrays * BudgetPoll::kTouch}; }

/// The same where only one access in so many is far from those before.
constexpr StepBytes at_random_one_in(std::size_t accesses) { return {BudgetPoll::kTouch / accesses}; }

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

/// Consecutive numbers first .. end - 1.
struct Block {
    std::size_t first, end;
    [[nodiscard]] std::size_t size() const { return end - first; }
};

/// for (const Block block : streamed_blocks(n, 4096)): 0 .. n - 1 in parts of at most so many numbers; the budget is enforced after each.
class StreamedBlocks {
public:
    class End {};
    class Iterator {
    public:
        Iterator(std::size_t count, std::size_t size) : count_(count), size_(size) {}
        [[nodiscard]] Block operator*() const { return {at_, std::min(at_ + size_, count_)}; }
        Iterator& operator++() {
            at_ = std::min(at_ + size_, count_);
            check_memory();
            return *this;
        }
        [[nodiscard]] friend bool operator==(const Iterator& it, End) { return it.at_ == it.count_; }

    private:
        std::size_t at_ = 0, count_, size_;
    };
    StreamedBlocks(std::size_t count, std::size_t size) : count_(count), size_(size) {}
    [[nodiscard]] Iterator begin() const { return {count_, size_}; }
    [[nodiscard]] End end() const { return {}; }

private:
    std::size_t count_, size_;
};
[[nodiscard]] inline StreamedBlocks streamed_blocks(std::size_t count, std::size_t size) { return {count, size}; }

/// Many paths through large arrays, which share one look at the budget:
///     StreamedPaths paths(at_random());
///     for (const EventId e : paths.from(leaf, [&](EventId at) { return at == root ? EventId::none() : parent[at]; }))
/// A path is the ids first, next(first), ... up to the last one that exists.
class StreamedPaths {
public:
    explicit StreamedPaths(StepBytes step) : step_(step) {}

    template <class I, class Next>
    class Path {
    public:
        class End {};
        class Iterator {
        public:
            explicit Iterator(const Path& path) : path_(&path), at_(path.first_) {}
            [[nodiscard]] I operator*() const {
                path_->paths_->poll_.step(path_->paths_->step_.bytes);
                return at_;
            }
            Iterator& operator++() {
                at_ = path_->next_(at_);
                return *this;
            }
            [[nodiscard]] friend bool operator==(const Iterator& it, End) { return !it.at_.exists(); }

        private:
            const Path* path_;
            I at_;
        };
        Path(StreamedPaths& paths, I first, const Next& next) : paths_(&paths), first_(first), next_(next) {}
        [[nodiscard]] Iterator begin() const { return Iterator(*this); }
        [[nodiscard]] End end() const { return {}; }

    private:
        StreamedPaths* paths_;
        I first_;
        Next next_;
    };
    template <class I, class Next>
    [[nodiscard]] Path<I, Next> from(I first, const Next& next) {
        return {*this, first, next};
    }

private:
    StepBytes step_;
    BudgetPoll poll_;
};

/// std::sort of a large array. step: of a comparison.
template <class Iterator, class Less>
void streamed_sort(Iterator begin, Iterator end, StepBytes step, const Less& less) {
    BudgetPoll poll;
    std::sort(begin, end, [&poll, step, &less](const auto& p, const auto& q) {
        poll.step(step.bytes);
        return less(p, q);
    });
}

template <class I = std::size_t>
[[nodiscard]] Streamed<I> streamed(std::size_t count, StepBytes step) {
    return {count, step, false};
}
template <class I = std::size_t>
[[nodiscard]] Streamed<I> streamed_down(std::size_t count, StepBytes step) {
    return {count, step, true};
}

/// From every id 0 .. count - 1 in order along a chain: x, x = visit(x), ... as long as goes_on(x). step: of a visit. at_seed(number): is
/// called before a chain, to fetch what a later one needs.
template <class I, class GoesOn, class Visit, class AtSeed = void (*)(std::size_t)>
void for_chains(std::size_t count, StepBytes step, const GoesOn& goes_on, const Visit& visit, const AtSeed& at_seed = [](std::size_t) {}) {
    BudgetPoll poll;
    for (std::size_t seed = 0; seed < count; ++seed) {
        poll.step(in_order(1).bytes);
        at_seed(seed);
        for (I x(seed); goes_on(x); x = visit(x)) poll.step(step.bytes);
    }
}

/// Calls visit(first, end) for the runs of equal items. step: of a run.
template <class T, class Visit>
void for_runs(std::span<const T> items, StepBytes step, const Visit& visit) {
    BudgetPoll poll;
    for (std::size_t first = 0, end = 1; first < items.size(); first = end++) {
        poll.step(step.bytes);
        while (end < items.size() && items[end] == items[first]) ++end;
        visit(first, end);
    }
}

/// Loops that share an allowance: for short ones, each of which would begin with a look at the budget.
class StreamedLoops {
public:
    template <class I, class Visit>
    void over(I first, I end, StepBytes step, const Visit& visit) {
        for (I i = first; i != end; ++i) {
            visit(i);
            poll_.step(step.bytes);
        }
    }

private:
    BudgetPoll poll_;
};

}  // namespace isoatlas
