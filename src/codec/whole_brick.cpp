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

/// Vectors of 16 bytes, or of 32: then two of 16, on processors that have nothing wider.
template <class N, std::size_t kBytes>
struct Vector {
    static constexpr std::size_t kSize = kBytes / sizeof(N), kHalf = 16 / sizeof(N);
    using Type [[gnu::vector_size(kBytes)]] = N;

    /// Numbers moved up by so many places within each 16 bytes, zeros below.
    template <std::size_t kPlaces, std::size_t... kAt>
    [[gnu::always_inline]] static void move(Type& v, std::index_sequence<kAt...>) {
        v = __builtin_shufflevector(Type{}, v, (static_cast<int>(kAt % kHalf < kPlaces ? kAt : kSize + kAt - kPlaces))...);
    }
    /// The last number of each 16 bytes at all their places.
    template <std::size_t... kAt>
    [[gnu::always_inline]] static void spread_last(Type& v, std::index_sequence<kAt...>) {
        v = __builtin_shufflevector(v, v, (static_cast<int>(kAt / kHalf * kHalf + kHalf - 1))...);
    }
    template <std::size_t kPlaces>
    [[gnu::always_inline]] static void add_moved(Type& v) {
        if constexpr (kPlaces < kHalf) {
            Type moved = v;
            move<kPlaces>(moved, std::make_index_sequence<kSize>());
            v += moved;
        }
    }
};

template <class Half, class Whole, std::size_t... kAt>
[[gnu::always_inline]] inline void join(const Half& first, const Half& second, Whole& whole, std::index_sequence<kAt...>) {
    whole = __builtin_shufflevector(first, second, static_cast<int>(kAt)...);
}

/// Each number of two lines that follow each other becomes the sum up to it, 16 bytes of both at a time.
template <class N>
struct TwoLines {
    using V = Vector<N, 32>;
    using Numbers = typename V::Type;
    using Half = typename Vector<N, 16>::Type;

    [[gnu::always_inline]] static void load(const N* lines, Numbers& both) {
        Half first, second;
        std::memcpy(&first, lines, 16), std::memcpy(&second, lines + kLine, 16);
        join(first, second, both, std::make_index_sequence<V::kSize>());
    }
    [[gnu::always_inline]] static void store(const Numbers& both, N* lines) {
        std::memcpy(lines, &both, 16), std::memcpy(lines + kLine, reinterpret_cast<const N*>(&both) + V::kHalf, 16);
    }
    /// before: the sum up to these, everywhere; becomes that up to the next ones.
    [[gnu::always_inline]] static void add_up(Numbers& both, Numbers& before) {
        V::template add_moved<1>(both);
        V::template add_moved<2>(both);
        V::template add_moved<4>(both);
        V::template add_moved<8>(both);
        both += before;
        before = both;
        V::spread_last(before, std::make_index_sequence<V::kSize>());
    }
};

/// Order 2 keeps the first number out of the first sum.
template <int kOrder, class N>
[[gnu::always_inline]] inline void undo_along_x(N* out) {
    using Two = TwoLines<N>;
    typename Two::Numbers first{};
    first[0] = first[Two::V::kHalf] = static_cast<N>(~N{0});
    for (N* lines = out; lines < out + kAll; lines += 2 * kLine) {
        typename Two::Numbers once{}, twice{};
        for (std::size_t x = 0; x < kLine; x += Two::V::kHalf) {
            typename Two::Numbers both;
            Two::load(lines + x, both);
            if constexpr (kOrder == 2) {
                const typename Two::Numbers kept = x == 0 ? both & first : typename Two::Numbers{};
                both ^= kept;
                Two::add_up(both, once);
                both |= kept;
            }
            Two::add_up(both, twice);
            Two::store(both, lines + x);
        }
    }
}

/// Lines of kLength numbers, kCount of them: each becomes the sum up to it; of order 2, before that, but for the first one, too. Vectors by
/// hand: the compiler does not see that lines of two bytes a number are one.
template <int kOrder, std::size_t kLength, std::size_t kCount, class N>
[[gnu::always_inline]] inline void undo_across(N* block) {
    using V = Vector<N, kLength * sizeof(N) % 32 == 0 ? 32 : 16>;
    for (std::size_t i = 0; i < kLength; i += V::kSize) {
        typename V::Type once{}, twice;
        std::memcpy(&twice, block + i, sizeof twice);
        for (std::size_t line = 1; line < kCount; ++line) {
            typename V::Type own;
            N* const to = block + i + line * kLength;
            std::memcpy(&own, to, sizeof own);
            if constexpr (kOrder == 2) own = once += own;
            twice += own;
            std::memcpy(to, &twice, sizeof twice);
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
    if (orders[0] == 1) undo_along_x<1>(to);
    if (orders[0] == 2) undo_along_x<2>(to);
    for (N* layer = to; layer < to + kAll; layer += kLayer) {
        if (orders[1] == 1) undo_across<1, kLine, kLinesOfLayer>(layer);
        if (orders[1] == 2) undo_across<2, kLine, kLinesOfLayer>(layer);
    }
    if (orders[2] == 1) undo_across<1, kLayer, kLayers>(to);
    if (orders[2] == 2) undo_across<2, kLayer, kLayers>(to);
}

#define ISOATLAS_INSTANTIATE(N) template void restore_whole_brick<N>(std::span<N>, const Orders&, std::span<N>)
ISOATLAS_INSTANTIATE(std::uint8_t);
ISOATLAS_INSTANTIATE(std::uint16_t);
ISOATLAS_INSTANTIATE(std::uint32_t);
ISOATLAS_INSTANTIATE(std::uint64_t);
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
