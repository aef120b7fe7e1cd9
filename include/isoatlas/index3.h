// Index3: three whole numbers along x, y and z: of a sample, a cell or a brick, or how many of them there are along each axis.
//
// It costs what an array of three numbers costs, and is no triple of points, which is what the triangles of a surface are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace isoatlas {

/// Not initialised by default, as an array; Index3{} is 0, 0, 0.
struct Index3 {
    using value_type = std::int64_t;
    using iterator = std::array<std::int64_t, 3>::iterator;
    using const_iterator = std::array<std::int64_t, 3>::const_iterator;

    std::array<std::int64_t, 3> along;

    [[nodiscard]] constexpr std::int64_t& operator[](std::size_t axis) noexcept { return along[axis]; }
    [[nodiscard]] constexpr const std::int64_t& operator[](std::size_t axis) const noexcept { return along[axis]; }
    [[nodiscard]] static constexpr std::size_t size() noexcept { return 3; }
    [[nodiscard]] constexpr iterator begin() noexcept { return along.begin(); }
    [[nodiscard]] constexpr iterator end() noexcept { return along.end(); }
    [[nodiscard]] constexpr const_iterator begin() const noexcept { return along.begin(); }
    [[nodiscard]] constexpr const_iterator end() const noexcept { return along.end(); }

    /// How many samples, cells or bricks a box of this size has.
    [[nodiscard]] constexpr std::int64_t product() const noexcept { return along[0] * along[1] * along[2]; }

    friend constexpr bool operator==(const Index3&, const Index3&) = default;
    friend constexpr Index3 operator+(const Index3& p, const Index3& q) noexcept { return {p[0] + q[0], p[1] + q[1], p[2] + q[2]}; }
    friend constexpr Index3 operator-(const Index3& p, const Index3& q) noexcept { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
    /// The same number along every axis.
    friend constexpr Index3 operator+(const Index3& p, std::int64_t n) noexcept { return {p[0] + n, p[1] + n, p[2] + n}; }
    friend constexpr Index3 operator-(const Index3& p, std::int64_t n) noexcept { return p + -n; }
    /// Along every axis by itself: the lower and the upper corner of two boxes together.
    friend constexpr Index3 min(const Index3& p, const Index3& q) noexcept {
        return {std::min(p[0], q[0]), std::min(p[1], q[1]), std::min(p[2], q[2])};
    }
    friend constexpr Index3 max(const Index3& p, const Index3& q) noexcept {
        return {std::max(p[0], q[0]), std::max(p[1], q[1]), std::max(p[2], q[2])};
    }
};

/// const auto [x, y, z] = voxel;
template <std::size_t axis>
[[nodiscard]] constexpr const std::int64_t& get(const Index3& index) noexcept {
    return index.along[axis];
}

}  // namespace isoatlas

template <>
struct std::tuple_size<isoatlas::Index3> : std::integral_constant<std::size_t, 3> {};
template <std::size_t axis>
struct std::tuple_element<axis, isoatlas::Index3> {
    using type = std::int64_t;
};
