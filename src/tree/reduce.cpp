#include "tree/reduce.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "tree/local_numbers.h"
#include "tree/marked_sets.h"

namespace isoatlas {
namespace {

template <class Number>
constexpr Number kNone = std::numeric_limits<Number>::max();

constexpr int kOpen = 3;  // stands for the branches of an open extremum, which is not removed as a leaf

/// One direction of sweeping over a part: down over the components above its elements, or up over those below. Extremum: of a maximum, or
/// of a minimum.
template <class Number, class Extremum>
class Side {
public:
    using Element = ElementIdOf<Number>;

    /// Representatives become numbers within the part, until rename(). first, end: of its own extrema.
    Side(std::span<PartitionedElement<Number>> elements, Extremum first, Extremum end)
        : elements_(elements), numbers_(number(first, end)) {}

    /// The next element of the part that the component just behind an element meets: right where the component is closed. In left, two
    /// branches of one component become one. Two open components may be one elsewhere, but nothing is removed from these.
    [[nodiscard]] std::vector<Element> parents(const BitRanks& open, std::span<std::uint8_t> left) {
        std::vector<Element> parent(elements_.size(), Element::none());
        components_.start(numbers_.size(), [](Number) { return kNone<Number>; });
        for (std::size_t step = 0; step < elements_.size(); ++step) {
            const std::size_t x = at(step);
            const auto [first, second] = local_names(x);
            if (branches(x) == 0) {
                components_.mark(first) = static_cast<Number>(x);
                if (open.has(numbers_.global(first))) set_branches(left[x], kOpen);
                continue;
            }
            const Number a = components_.find(first), b = branches(x) == 2 ? components_.find(second) : a;
            for (const Number c : {a, b}) {
                if (components_.mark(c) != kNone<Number>) parent[components_.mark(c)] = Element(x);
            }
            set_branches(left[x], a == b ? 1 : 2);
            components_.mark(components_.join(a, b)) = static_cast<Number>(x);
        }
        return parent;
    }

    /// Representatives of what is left. left: per element what was counted and not removed.
    void rename(std::span<const std::uint8_t> left) {
        const auto survives = [&](std::size_t x) { return left[x] != kRemoved; };
        components_.start(numbers_.size(), [&](Number c) { return c >= numbers_.own() ? c : kNone<Number>; });
        for (std::size_t step = 0; step < elements_.size(); ++step) {
            const std::size_t x = at(step);
            const auto [first, second] = local_names(x);
            if (branches(x) == 0) {
                if (survives(x)) components_.mark(first) = first;
            } else {
                const Number a = components_.find(first), b = branches(x) == 2 ? components_.find(second) : a;
                const Number name_a = components_.mark(a), name_b = a == b ? kNone<Number> : components_.mark(b);
                Number name = name_a != kNone<Number> ? name_a : name_b;
                if (survives(x)) {
                    const int count = (name_a != kNone<Number>)+(name_b != kNone<Number>);
                    ISOATLAS_CHECK(count == side_of(left[x]));
                    if (count == 0) name = first;  // no component has this representative any more
                    set_branches(elements_[x].branches, count);
                    names(x) = {Extremum(name), Extremum(count == 2 ? name_b : name)};
                }
                components_.mark(components_.join(a, b)) = name;
            }
        }
        for (std::size_t x = 0; x < elements_.size(); ++x) {
            for (Extremum& name : names(x)) name = Extremum(numbers_.global(name.number()));
        }
    }

private:
    static constexpr bool kDown = std::is_same_v<Extremum, MaximumIdOf<Number>>;

    [[nodiscard]] std::size_t at(std::size_t step) const { return kDown ? step : elements_.size() - 1 - step; }
    [[nodiscard]] static auto& names_of(auto& element) {
        if constexpr (kDown) {
            return element.representatives.above;
        } else {
            return element.representatives.below;
        }
    }
    [[nodiscard]] std::array<Extremum, 2>& names(std::size_t x) { return names_of(elements_[x]); }
    [[nodiscard]] std::array<Number, 2> local_names(std::size_t x) { return {names(x)[0].number(), names(x)[1].number()}; }
    [[nodiscard]] static int side_of(std::uint8_t left) { return kDown ? branches_above(left) : branches_below(left); }
    [[nodiscard]] int branches(std::size_t x) const { return side_of(elements_[x].branches); }
    static void set_branches(std::uint8_t& of, int count) {
        of = kDown ? branches_of(count, branches_below(of)) : branches_of(branches_above(of), count);
    }

    [[nodiscard]] LocalNumbers<Number> number(Extremum first, Extremum end) {
        std::vector<Number> foreign;
        for (const PartitionedElement<Number>& element : elements_) {
            for (const Extremum name : names_of(element)) {
                if (name < first || name >= end) foreign.push_back(name.number());
            }
        }
        LocalNumbers<Number> numbers(first.number(), end.number(), std::move(foreign));
        for (PartitionedElement<Number>& element : elements_) {
            for (Extremum& name : names_of(element)) name = Extremum(numbers.local(name.number()));
        }
        return numbers;
    }

    std::span<PartitionedElement<Number>> elements_;
    LocalNumbers<Number> numbers_;
    MarkedSets<Number> components_;  // marks: first the last element, then the representative
};

constexpr std::uint8_t kOneAbove = branches_of(1, 0), kOneBelow = branches_of(0, 1);

/// Removes leaves as long as the other ends of their arcs are known. A leaf of one tree had one child in the other and is passed over
/// there: alive() follows parents through elements that are gone.
template <class Element>
void peel(std::span<Element> join, std::span<Element> split, std::span<std::uint8_t> left, std::span<Element> arc) {
    const auto alive = [&](std::span<Element> parent, std::size_t x) {
        Element next = parent[x];
        while (next.exists() && left[next.index()] == kRemoved) next = parent[next.index()];
        return parent[x] = next;
    };
    for (std::size_t seed = 0; seed < left.size(); ++seed) {
        for (std::size_t x = seed; left[x] == kOneBelow || left[x] == kOneAbove;) {
            const bool upper = left[x] == kOneBelow;
            const Element y = alive(upper ? join : split, x);
            if (!y.exists()) break;
            arc[x] = y;
            left[x] = kRemoved;
            left[y.index()] = static_cast<std::uint8_t>(left[y.index()] - (upper ? kOneAbove : kOneBelow));
            x = y.index();
        }
    }
}

}  // namespace

template <class Number>
OpenExtrema open_extrema(const PartitionedSet<Number>& set, int threads) {
    OpenExtrema open{BitRanks(set.first_maximum.back().index()), BitRanks(set.first_minimum.back().index())};
    for_each_block(threads, static_cast<std::int64_t>(set.parts()), [&](std::int64_t part) {
        const auto mark = [part]<class Extremum>(BitRanks& bits, const std::vector<Extremum>& first, const std::array<Extremum, 2>& names) {
            for (const Extremum name : names) {
                if (name < first[part] || name >= first[part + 1]) bits.add(name.index());
            }
        };
        for (const PartitionedElement<Number>& element : set.of(part, set.elements)) {
            mark(open.maxima, set.first_maximum, element.representatives.above);
            mark(open.minima, set.first_minimum, element.representatives.below);
        }
    });
    return open;
}

template <class Number>
void reduce_part(const PartitionedSet<Number>& set, std::size_t part, const OpenExtrema& open,
                 std::span<PartitionedElement<Number>> elements, std::span<ElementIdOf<Number>> arc) {
    using Element = ElementIdOf<Number>;
    Side<Number, MaximumIdOf<Number>> above(elements, set.first_maximum[part], set.first_maximum[part + 1]);
    Side<Number, MinimumIdOf<Number>> below(elements, set.first_minimum[part], set.first_minimum[part + 1]);
    std::vector<std::uint8_t> left;
    left.reserve(elements.size());
    for (const PartitionedElement<Number>& element : elements) left.push_back(element.branches);
    {
        std::vector<Element> join = above.parents(open.maxima, left), split = below.parents(open.minima, left);
        peel<Element>(join, split, left, arc);
    }
    above.rename(left);
    below.rename(left);
    for (std::size_t x = 0; x < left.size(); ++x) {
        if (left[x] == kRemoved) elements[x].branches = kRemoved;
    }
}

// NOLINTBEGIN(bugprone-macro-parentheses): Number is a type
#define ISOATLAS_REDUCE(Number)                                                                                                      \
    template OpenExtrema open_extrema(const PartitionedSet<Number>&, int);                                                           \
    template void reduce_part(const PartitionedSet<Number>&, std::size_t, const OpenExtrema&, std::span<PartitionedElement<Number>>, \
                              std::span<ElementIdOf<Number>>);
ISOATLAS_REDUCE(std::uint32_t)
ISOATLAS_REDUCE(std::uint64_t)
#undef ISOATLAS_REDUCE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas
