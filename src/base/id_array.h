// Arrays that are indexed by ids of one kind (isoatlas/id.h). They cost what arrays cost.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "isoatlas/array.h"
#include "isoatlas/id.h"

namespace isoatlas {

/// An id of the same things, as wide or not.
template <class J, class I>
concept SameKind = std::same_as<typename J::Tag, typename I::Tag>;

/// The position in an array of a number, or of an id.
constexpr std::size_t index_of(std::integral auto number) noexcept { return static_cast<std::size_t>(number); }
template <class Tag, class Number>
constexpr std::size_t index_of(StrongId<Tag, Number> id) noexcept {
    return id.index();
}

template <class I, class T>
class IdSpan {
public:
    constexpr IdSpan() = default;
    constexpr explicit IdSpan(std::span<T> items) noexcept : items_(items) {}
    template <class U>
        requires(std::convertible_to<std::span<U>, std::span<T>> && !std::same_as<U, T>)
    constexpr IdSpan(IdSpan<I, U> other) noexcept : items_(other.items()) {}  // NOLINT(google-explicit-constructor): as a span of const

    template <SameKind<I> J>
    [[nodiscard]] constexpr T& operator[](J id) const {
        return items_[id.index()];
    }
    [[nodiscard]] constexpr std::size_t size() const noexcept { return items_.size(); }
    [[nodiscard]] constexpr bool empty() const noexcept { return items_.empty(); }
    [[nodiscard]] constexpr IdRange<I> ids() const noexcept { return IdRange<I>(items_.size()); }
    [[nodiscard]] constexpr std::span<T> items() const noexcept { return items_; }

private:
    std::span<T> items_;
};

template <class I, class T>
class IdArray {
public:
    IdArray() = default;
    explicit IdArray(std::size_t count) : items_(count) {}  ///< not initialised, where a T is not by default
    IdArray(std::size_t count, const T& item) : items_(count, item) {}
    explicit IdArray(Array<T> items) noexcept : items_(std::move(items)) {}

    template <SameKind<I> J>
    [[nodiscard]] T& operator[](J id) {
        return items_[id.index()];
    }
    template <SameKind<I> J>
    [[nodiscard]] const T& operator[](J id) const {
        return items_[id.index()];
    }
    [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }
    [[nodiscard]] bool empty() const noexcept { return items_.empty(); }
    [[nodiscard]] IdRange<I> ids() const noexcept { return IdRange<I>(items_.size()); }
    void push_back(const T& item) { items_.push_back(item); }
    /// As a plain array, to be resized, filled, read or written as a whole.
    [[nodiscard]] Array<T>& items() noexcept { return items_; }
    [[nodiscard]] const Array<T>& items() const noexcept { return items_; }
    // NOLINTNEXTLINE(google-explicit-constructor): as an array to a span
    operator IdSpan<I, const T>() const noexcept { return IdSpan<I, const T>(std::span<const T>(items_)); }
    // NOLINTNEXTLINE(google-explicit-constructor)
    operator IdSpan<I, T>() noexcept { return IdSpan<I, T>(std::span<T>(items_)); }
    friend bool operator==(const IdArray&, const IdArray&) = default;

private:
    Array<T> items_;
};

/// The numbers of ids, and back: for files, and for what is a tree of other things at the same time.
template <class I>
    requires std::is_trivially_copyable_v<I>
[[nodiscard]] std::span<const typename I::Number> numbers_of(std::span<const I> ids) noexcept {
    static_assert(sizeof(I) == sizeof(typename I::Number));
    return {reinterpret_cast<const typename I::Number*>(ids.data()), ids.size()};
}
template <class I>
[[nodiscard]] std::span<const I> ids_of(std::span<const typename I::Number> numbers) noexcept {
    static_assert(sizeof(I) == sizeof(typename I::Number));
    return {reinterpret_cast<const I*>(numbers.data()), numbers.size()};
}

}  // namespace isoatlas
