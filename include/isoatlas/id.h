// Ids: numbers of things of one kind, which mix neither with those of another kind nor with counts.
//
// An id is as wide as the integer in it and costs what that costs. Arrays that are indexed by an id: src/base/id_array.h.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace isoatlas {

/// Kind: what is numbered, from 0. Not initialised by default, as an integer.
template <class Kind, std::integral Width>
class StrongId {
public:
    using Tag = Kind;
    using Number = Width;

    StrongId() = default;
    template <std::integral N>
    constexpr explicit StrongId(N number) noexcept : number_(static_cast<Number>(number)) {}
    template <std::integral N>
        requires(!std::same_as<N, Number>)
    constexpr explicit StrongId(StrongId<Tag, N> other) noexcept
        : number_(other.exists() ? static_cast<Number>(other.number()) : none().number()) {}

    /// No thing: -1, or the largest unsigned number.
    [[nodiscard]] static constexpr StrongId none() noexcept { return StrongId(static_cast<Number>(-1)); }
    [[nodiscard]] constexpr bool exists() const noexcept { return *this != none(); }
    [[nodiscard]] constexpr Number number() const noexcept { return number_; }
    /// In an array by these ids; the id exists.
    [[nodiscard]] constexpr std::size_t index() const noexcept { return static_cast<std::size_t>(number_); }
    [[nodiscard]] constexpr StrongId next() const noexcept { return StrongId(static_cast<Number>(number_ + 1)); }
    [[nodiscard]] constexpr StrongId previous() const noexcept { return StrongId(static_cast<Number>(number_ - 1)); }
    constexpr StrongId& operator++() noexcept {
        ++number_;
        return *this;
    }
    friend constexpr auto operator<=>(const StrongId&, const StrongId&) = default;

private:
    Number number_;
};

/// The ids first .. end - 1, for a loop.
template <class I>
class IdRange {
public:
    class Iterator {
    public:
        constexpr explicit Iterator(I at) noexcept : at_(at) {}
        constexpr I operator*() const noexcept { return at_; }
        constexpr Iterator& operator++() noexcept {
            ++at_;
            return *this;
        }
        friend constexpr bool operator==(const Iterator&, const Iterator&) = default;

    private:
        I at_;
    };
    constexpr explicit IdRange(std::size_t count) noexcept : first_(0), end_(count) {}
    constexpr IdRange(I first, I end) noexcept : first_(first), end_(end) {}
    [[nodiscard]] constexpr Iterator begin() const noexcept { return Iterator(first_); }
    [[nodiscard]] constexpr Iterator end() const noexcept { return Iterator(end_); }

private:
    I first_, end_;
};

/// for (const EventId e : ids<EventId>(analysis.event_count())): the ids 0 .. count - 1.
template <class I>
[[nodiscard]] constexpr IdRange<I> ids(std::integral auto count) noexcept {
    return IdRange<I>(static_cast<std::size_t>(count));
}

/// Numbers as narrow as the volume allows in the arrays of the engine (std::uint32_t, std::uint64_t), std::int64_t elsewhere.
template <class Number>
using VoxelIdOf = StrongId<struct VoxelTag, Number>;
template <class Number>
using ElementIdOf = StrongId<struct ElementTag, Number>;
template <class Number>
using EventIdOf = StrongId<struct EventTag, Number>;
template <class Number>
using BranchIdOf = StrongId<struct BranchTag, Number>;

using VoxelId = VoxelIdOf<std::int64_t>;      ///< of a sample: x + nx * (y + ny * z)
using ElementId = ElementIdOf<std::int64_t>;  ///< of a critical element: its place in descending total order
using EventId = EventIdOf<std::int64_t>;      ///< of a node of the criticality tree: children before their parent
using BranchId = BranchIdOf<std::int64_t>;    ///< of a branch of the branch decomposition

}  // namespace isoatlas

template <class Tag, std::integral Number>
struct std::hash<isoatlas::StrongId<Tag, Number>> {
    [[nodiscard]] std::size_t operator()(isoatlas::StrongId<Tag, Number> id) const noexcept { return std::hash<Number>()(id.number()); }
};
