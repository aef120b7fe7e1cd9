// Notation: a line is the 16 numbers along x of one (y, z); a layer, the 8 lines of one z. Differences along different axes commute, so
// they are undone along x, y and z in turn, each in vectors across the others.
#include "codec/whole_brick.h"

#include <array>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "base/target_clones.h"

namespace isoatlas {
namespace {

constexpr std::size_t kLine = static_cast<std::size_t>(kBrickSize[0]);
constexpr std::size_t kLinesOfLayer = static_cast<std::size_t>(kBrickSize[1]);
constexpr std::size_t kLayers = static_cast<std::size_t>(kBrickSize[2]);
constexpr std::size_t kLines = kLinesOfLayer * kLayers;
constexpr std::size_t kLayer = kLine * kLinesOfLayer;
constexpr std::size_t kAll = kLine * kLines;
static_assert(kAll == static_cast<std::size_t>(kBrickSamples));

/// 16 bytes: a vector of every processor.
template <class N>
struct Vector {
    static constexpr std::size_t kSize = 16 / sizeof(N);
    using Type [[gnu::vector_size(16)]] = N;

    [[gnu::always_inline]] static Type at(const N* numbers) {
        Type v;
        std::memcpy(&v, numbers, sizeof v);
        return v;
    }
    /// Numbers moved up by so many places, zeros below.
    template <std::size_t kPlaces, std::size_t... kAt>
    [[gnu::always_inline]] static Type moved(Type v, std::index_sequence<kAt...>) {
        return __builtin_shufflevector(Type{}, v, (kAt < kPlaces ? static_cast<int>(kAt) : static_cast<int>(kSize + kAt - kPlaces))...);
    }
    template <std::size_t... kAt>
    [[gnu::always_inline]] static Type last_everywhere(Type v, std::index_sequence<kAt...>) {
        return __builtin_shufflevector(v, v, (kAt * 0 + kSize - 1)...);
    }
    template <std::size_t kPlaces>
    [[gnu::always_inline]] static void add_moved(Type& v) {
        if constexpr (kPlaces < kSize) v += moved<kPlaces>(v, std::make_index_sequence<kSize>());
    }
};

/// Each number of a line becomes the sum up to it.
template <class N>
[[gnu::always_inline]] inline void add_up(N* line) {
    using V = Vector<N>;
    typename V::Type before{};
    for (std::size_t x = 0; x < kLine; x += V::kSize) {
        typename V::Type sum = V::at(line + x);
        V::template add_moved<1>(sum);
        V::template add_moved<2>(sum);
        V::template add_moved<4>(sum);
        V::template add_moved<8>(sum);
        sum += before;
        std::memcpy(line + x, &sum, sizeof sum);
        before = V::last_everywhere(sum, std::make_index_sequence<V::kSize>());
    }
}

/// Order 2 keeps the first number out of the first sum.
template <class N>
[[gnu::always_inline]] inline void undo_along_x(N* out, int order) {
    if (order == 2) {
        std::array<N, kLines> first;
        for (std::size_t i = 0; i < kLines; ++i) first[i] = std::exchange(out[i * kLine], N{0});
        for (std::size_t i = 0; i < kLines; ++i) add_up(out + i * kLine);
        for (std::size_t i = 0; i < kLines; ++i) out[i * kLine] = first[i];
    }
    if (order >= 1) {
        for (std::size_t i = 0; i < kLines; ++i) add_up(out + i * kLine);
    }
}

/// Lines of kLength numbers, kCount of them: to each, from `first` on, the one before is added. Vectors by hand: the compiler does not see
/// that lines of two bytes a number are one.
template <std::size_t kLength, std::size_t kCount, class N>
[[gnu::always_inline]] inline void add_lines(N* block, std::size_t first) {
    using V = Vector<N>;
    for (std::size_t i = 0; i < kLength; i += V::kSize) {
        typename V::Type sum = V::at(block + i + (first - 1) * kLength);
        for (std::size_t line = first; line < kCount; ++line) {
            N* const to = block + i + line * kLength;
            sum += V::at(to);
            std::memcpy(to, &sum, sizeof sum);
        }
    }
}

/// Where a line is stored among all lines: those of y = 0 first where the order along y is 1, then y = 1 where it is 2, then the others.
[[gnu::always_inline]] inline std::size_t stored_line(std::size_t y, std::size_t z, std::size_t order) {
    return y < order ? y * kLayers + z : order * kLayers + z * (kLinesOfLayer - order) + (y - order);
}

template <std::size_t kOrder, class N>
[[gnu::always_inline]] inline void place_lines(const N* arranged, std::size_t order_y, N* out) {
    const N* const rest = arranged + kOrder * kLines;
    for (std::size_t z = 0; z < kLayers; ++z) {
        for (std::size_t y = 0; y < kLinesOfLayer; ++y) {
            const std::size_t line = stored_line(y, z, order_y);
            N* const to = out + kLine * (y + kLinesOfLayer * z);
            std::memcpy(to, rest + line * (kLine - kOrder) - kOrder, kLine * sizeof(N));
            for (std::size_t x = 0; x < kOrder; ++x) to[x] = arranged[x * kLines + line];
        }
    }
}

}  // namespace

template <class N>
ISOATLAS_TARGET_CLONES void restore_whole_brick(std::span<N> arranged, const Orders& orders, std::span<N> out) {
    ISOATLAS_CHECK(arranged.size() == kAll && out.size() == kAll);
    N* const from = arranged.data();
    N* const to = out.data();
    if (orders != Orders{0, 0, 0}) {
        for (std::size_t i = 0; i < kAll; ++i) from[i] = static_cast<N>(static_cast<N>(from[i] >> 1) ^ static_cast<N>(0 - (from[i] & 1)));
    }
    const auto order_y = static_cast<std::size_t>(orders[1]);
    if (orders[0] == 0) place_lines<0>(from, order_y, to);
    if (orders[0] == 1) place_lines<1>(from, order_y, to);
    if (orders[0] == 2) place_lines<2>(from, order_y, to);
    undo_along_x(to, orders[0]);
    for (int order = orders[1]; order >= 1; --order) {
        for (std::size_t z = 0; z < kLayers; ++z) add_lines<kLine, kLinesOfLayer>(to + z * kLayer, static_cast<std::size_t>(order));
    }
    for (int order = orders[2]; order >= 1; --order) add_lines<kLayer, kLayers>(to, static_cast<std::size_t>(order));
}

#define ISOATLAS_INSTANTIATE(N) template void restore_whole_brick<N>(std::span<N>, const Orders&, std::span<N>)
ISOATLAS_INSTANTIATE(std::uint8_t);
ISOATLAS_INSTANTIATE(std::uint16_t);
ISOATLAS_INSTANTIATE(std::uint32_t);
ISOATLAS_INSTANTIATE(std::uint64_t);
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
