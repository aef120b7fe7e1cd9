#include "codec/differences.h"

#include <algorithm>
#include <type_traits>

#include "base/target_clones.h"

namespace isoatlas {
namespace {

/// A box as blocks of lines: differences of neighbouring lines are those along one axis.
struct Lines {
    std::int64_t blocks, lines, length;
};

Lines lines_of(const Index3& size, int axis) {
    if (axis == 0) return {size[1] * size[2], size[0], 1};
    if (axis == 1) return {size[2], size[1], size[0]};
    return {1, size[2], size[0] * size[1]};
}

/// Subtracts from each line, starting with line `first`, its predecessor.
template <class N>
void subtract(N* numbers, const Lines& shape, std::int64_t first) {
    const std::int64_t length = shape.length;
    for (std::int64_t block = 0; block < shape.blocks; ++block, numbers += shape.lines * length) {
        for (std::int64_t i = shape.lines * length - 1; i >= first * length; --i)
            numbers[i] = static_cast<N>(numbers[i] - numbers[i - length]);
    }
}

/// Inverse: prefix sums.
template <class N>
[[gnu::always_inline]] inline void add(N* numbers, const Lines& shape, std::int64_t first) {
    for (std::int64_t block = 0; block < shape.blocks; ++block, numbers += shape.lines * shape.length) {
        for (std::int64_t line = first; line < shape.lines; ++line) {
            N* to = numbers + line * shape.length;
            for (std::int64_t i = 0; i < shape.length; ++i) to[i] = static_cast<N>(to[i] + to[i - shape.length]);
        }
    }
}

/// The same for both orders along x, where a line is one number.
template <class N>
[[gnu::always_inline]] inline void add_along_rows(N* numbers, std::int64_t rows, std::int64_t length, int order) {
    for (std::int64_t row = 0; row < rows; ++row, numbers += length) {
        N sum = numbers[0], slope = order == 2 && length > 1 ? numbers[1] : N{0};
        if (order == 1) {
            for (std::int64_t i = 1; i < length; ++i) numbers[i] = sum = static_cast<N>(sum + numbers[i]);
            continue;
        }
        if (length > 1) numbers[1] = sum = static_cast<N>(sum + slope);
        for (std::int64_t i = 2; i < length; ++i) {
            slope = static_cast<N>(slope + numbers[i]);
            numbers[i] = sum = static_cast<N>(sum + slope);
        }
    }
}

bool are_signed(const Orders& orders) { return orders != Orders{0, 0, 0}; }

template <class N>
N without_sign(N number) {
    using Signed = std::make_signed_t<N>;
    return static_cast<N>(static_cast<N>(number << 1) ^ static_cast<N>(static_cast<Signed>(number) >> (8 * sizeof(N) - 1)));
}

template <class N>
N with_sign(N number) {
    return static_cast<N>(static_cast<N>(number >> 1) ^ static_cast<N>(N{0} - static_cast<N>(number & 1)));
}

/// [begin, end) of each axis in turn: numbers whose difference along it has order 0, then 1, then 2.
struct Stretch {
    std::int64_t begin, end;
};

std::span<const Stretch> stretches(std::int64_t size, int order, std::array<Stretch, 3>& all) {
    std::size_t count = 0;
    for (std::int64_t begin = 0; begin < size; ++count) {
        const std::int64_t end = static_cast<int>(count) < order ? begin + 1 : size;
        all[count] = {begin, end};
        begin = end;
    }
    return std::span(all).first(count);
}

/// Calls visit(first number, length) for every part of a row in the order in which they are stored.
template <class Visit>
[[gnu::always_inline]] inline void for_each_part(const Index3& size, const Orders& orders, const Visit& visit) {
    std::array<Stretch, 3> along_x, along_y;
    for (const Stretch& xs : stretches(size[0], orders[0], along_x)) {
        for (const Stretch& ys : stretches(size[1], orders[1], along_y)) {
            for (std::int64_t z = 0; z < size[2]; ++z) {
                for (std::int64_t y = ys.begin; y < ys.end; ++y) visit(xs.begin + size[0] * (y + size[1] * z), xs.end - xs.begin);
            }
        }
    }
}

}  // namespace

template <class N>
ISOATLAS_TARGET_CLONES void take_differences(std::span<N> numbers, const Index3& size, const Orders& orders) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int order = 1; order <= orders[axis]; ++order) subtract(numbers.data(), lines_of(size, axis), order);
    }
}

template <class N>
ISOATLAS_TARGET_CLONES void undo_differences(std::span<N> numbers, const Index3& size, const Orders& orders) {
    for (int axis = 2; axis >= 0; --axis) {
        if (axis == 0 && orders[0] > 0) add_along_rows(numbers.data(), size[1] * size[2], size[0], orders[0]);
        for (int order = axis == 0 ? 0 : orders[axis]; order >= 1; --order) add(numbers.data(), lines_of(size, axis), order);
    }
}

template <class N>
ISOATLAS_TARGET_CLONES void arrange(std::span<const N> differences, const Index3& size, const Orders& orders, std::span<N> out) {
    N* to = out.data();
    for_each_part(size, orders, [&](std::int64_t first, std::int64_t length) { to = std::copy_n(differences.data() + first, length, to); });
    if (are_signed(orders)) std::transform(out.begin(), out.end(), out.begin(), without_sign<N>);
}

template <class N>
ISOATLAS_TARGET_CLONES void disarrange(std::span<N> arranged, const Index3& size, const Orders& orders, std::span<N> out) {
    if (are_signed(orders)) std::transform(arranged.begin(), arranged.end(), arranged.begin(), with_sign<N>);
    const N* from = arranged.data();
    for_each_part(size, orders, [&](std::int64_t first, std::int64_t length) {
        for (std::int64_t i = 0; i < length; ++i) out[static_cast<std::size_t>(first + i)] = from[i];
        from += length;
    });
}

#define ISOATLAS_INSTANTIATE(N)                                                               \
    template void take_differences<N>(std::span<N>, const Index3&, const Orders&);            \
    template void undo_differences<N>(std::span<N>, const Index3&, const Orders&);            \
    template void arrange<N>(std::span<const N>, const Index3&, const Orders&, std::span<N>); \
    template void disarrange<N>(std::span<N>, const Index3&, const Orders&, std::span<N>)
ISOATLAS_INSTANTIATE(std::uint8_t);
ISOATLAS_INSTANTIATE(std::uint16_t);
ISOATLAS_INSTANTIATE(std::uint32_t);
ISOATLAS_INSTANTIATE(std::uint64_t);
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
