#include "tree/reduce.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "tree/local_numbers.h"
#include "tree/marked_sets.h"

namespace isoatlas {
namespace {

template <class Id>
constexpr Id kNone = std::numeric_limits<Id>::max();

constexpr int kOpen = 3;  // stands for the branches of an open extremum, which is not removed as a leaf

/// One direction of sweeping over a part: down over the components above its elements, or up over those below.
template <class Id>
class Side {
public:
    using Names = std::array<Id, 2> Representatives<Id>::*;

    /// Representatives become numbers within the part, until rename(). first, end: of its own extrema.
    Side(std::span<PartitionedElement<Id>> elements, bool down, Id first, Id end)
        : elements_(elements),
          down_(down),
          names_(down ? &Representatives<Id>::above : &Representatives<Id>::below),
          numbers_(number(first, end)) {}

    /// The next element of the part that the component just behind an element meets: right where the component is closed. In left, two
    /// branches of one component become one. Two open components may be one elsewhere, but nothing is removed from these.
    [[nodiscard]] std::vector<Id> parents(const BitRanks& open, std::span<std::uint8_t> left) {
        std::vector<Id> parent(elements_.size(), kNone<Id>);
        components_.start(numbers_.size(), [](Id) { return kNone<Id>; });
        for (std::size_t step = 0; step < elements_.size(); ++step) {
            const std::size_t x = at(step);
            const auto [first, second] = names(x);
            if (branches(x) == 0) {
                components_.mark(first) = static_cast<Id>(x);
                if (open.has(numbers_.global(first))) set_branches(left[x], kOpen);
                continue;
            }
            const Id a = components_.find(first), b = branches(x) == 2 ? components_.find(second) : a;
            for (const Id c : {a, b}) {
                if (components_.mark(c) != kNone<Id>) parent[components_.mark(c)] = static_cast<Id>(x);
            }
            set_branches(left[x], a == b ? 1 : 2);
            components_.mark(components_.join(a, b)) = static_cast<Id>(x);
        }
        return parent;
    }

    /// Representatives of what is left. left: per element what was counted and not removed.
    void rename(std::span<const std::uint8_t> left) {
        const auto survives = [&](std::size_t x) { return left[x] != kRemoved; };
        components_.start(numbers_.size(), [&](Id c) { return c >= numbers_.own() ? c : kNone<Id>; });
        for (std::size_t step = 0; step < elements_.size(); ++step) {
            const std::size_t x = at(step);
            const auto [first, second] = names(x);
            if (branches(x) == 0) {
                if (survives(x)) components_.mark(first) = first;
            } else {
                const Id a = components_.find(first), b = branches(x) == 2 ? components_.find(second) : a;
                const Id name_a = components_.mark(a), name_b = a == b ? kNone<Id> : components_.mark(b);
                Id name = name_a != kNone<Id> ? name_a : name_b;
                if (survives(x)) {
                    const int count = (name_a != kNone<Id>)+(name_b != kNone<Id>);
                    ISOATLAS_CHECK(count == side_of(left[x]));
                    if (count == 0) name = first;  // no component has this representative any more
                    set_branches(elements_[x].branches, count);
                    names(x) = {name, count == 2 ? name_b : name};
                }
                components_.mark(components_.join(a, b)) = name;
            }
        }
        for (std::size_t x = 0; x < elements_.size(); ++x) {
            for (Id& name : names(x)) name = numbers_.global(name);
        }
    }

private:
    [[nodiscard]] std::size_t at(std::size_t step) const { return down_ ? step : elements_.size() - 1 - step; }
    [[nodiscard]] std::array<Id, 2>& names(std::size_t x) { return elements_[x].representatives.*names_; }
    [[nodiscard]] int side_of(std::uint8_t left) const { return down_ ? branches_above(left) : branches_below(left); }
    [[nodiscard]] int branches(std::size_t x) const { return side_of(elements_[x].branches); }
    void set_branches(std::uint8_t& of, int count) const {
        of = down_ ? branches_of(count, branches_below(of)) : branches_of(branches_above(of), count);
    }

    [[nodiscard]] LocalNumbers<Id> number(Id first, Id end) {
        std::vector<Id> foreign;
        for (const PartitionedElement<Id>& element : elements_) {
            for (const Id name : element.representatives.*names_) {
                if (name < first || name >= end) foreign.push_back(name);
            }
        }
        LocalNumbers<Id> numbers(first, end, std::move(foreign));
        for (PartitionedElement<Id>& element : elements_) {
            for (Id& name : element.representatives.*names_) name = numbers.local(name);
        }
        return numbers;
    }

    std::span<PartitionedElement<Id>> elements_;
    bool down_;
    Names names_;
    LocalNumbers<Id> numbers_;
    MarkedSets<Id> components_;  // marks: first the last element, then the representative
};

constexpr std::uint8_t kOneAbove = branches_of(1, 0), kOneBelow = branches_of(0, 1);

/// Removes leaves as long as the other ends of their arcs are known. A leaf of one tree had one child in the other and is passed over
/// there: alive() follows parents through elements that are gone.
template <class Id>
void peel(std::span<Id> join, std::span<Id> split, std::span<std::uint8_t> left, std::span<Id> arc) {
    const auto alive = [&](std::span<Id> parent, std::size_t x) {
        Id next = parent[x];
        while (next != kNone<Id> && left[next] == kRemoved) next = parent[next];
        return parent[x] = next;
    };
    for (std::size_t seed = 0; seed < left.size(); ++seed) {
        for (std::size_t x = seed; left[x] == kOneBelow || left[x] == kOneAbove;) {
            const bool upper = left[x] == kOneBelow;
            const Id y = alive(upper ? join : split, x);
            if (y == kNone<Id>) break;
            arc[x] = y;
            left[x] = kRemoved;
            left[y] = static_cast<std::uint8_t>(left[y] - (upper ? kOneAbove : kOneBelow));
            x = y;
        }
    }
}

}  // namespace

template <class Id>
OpenExtrema open_extrema(const PartitionedSet<Id>& set, int threads) {
    OpenExtrema open{BitRanks(set.first_maximum.back()), BitRanks(set.first_minimum.back())};
    for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
        const auto mark = [part](BitRanks& bits, const std::vector<Id>& first, const std::array<Id, 2>& names) {
            for (const Id name : names) {
                if (name < first[part] || name >= first[part + 1]) bits.add(name);
            }
        };
        for (const PartitionedElement<Id>& element : set.of(part, set.elements)) {
            mark(open.maxima, set.first_maximum, element.representatives.above);
            mark(open.minima, set.first_minimum, element.representatives.below);
        }
    });
    return open;
}

template <class Id>
void reduce_part(const PartitionedSet<Id>& set, std::size_t part, const OpenExtrema& open, std::span<PartitionedElement<Id>> elements,
                 std::span<Id> arc) {
    Side<Id> above(elements, true, set.first_maximum[part], set.first_maximum[part + 1]);
    Side<Id> below(elements, false, set.first_minimum[part], set.first_minimum[part + 1]);
    std::vector<std::uint8_t> left;
    left.reserve(elements.size());
    for (const PartitionedElement<Id>& element : elements) left.push_back(element.branches);
    {
        std::vector<Id> join = above.parents(open.maxima, left), split = below.parents(open.minima, left);
        peel<Id>(join, split, left, arc);
    }
    above.rename(left);
    below.rename(left);
    for (std::size_t x = 0; x < left.size(); ++x) {
        if (left[x] == kRemoved) elements[x].branches = kRemoved;
    }
}

template OpenExtrema open_extrema(const PartitionedSet<std::uint32_t>&, int);
template OpenExtrema open_extrema(const PartitionedSet<std::uint64_t>&, int);
template void reduce_part(const PartitionedSet<std::uint32_t>&, std::size_t, const OpenExtrema&,
                          std::span<PartitionedElement<std::uint32_t>>, std::span<std::uint32_t>);
template void reduce_part(const PartitionedSet<std::uint64_t>&, std::size_t, const OpenExtrema&,
                          std::span<PartitionedElement<std::uint64_t>>, std::span<std::uint64_t>);

}  // namespace isoatlas
