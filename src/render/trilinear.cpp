#include "render/trilinear.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "base/sample_types.h"
#include "base/target_clones.h"

namespace isoatlas {
namespace {

using FourFloats = float __attribute__((vector_size(16)));
using EightWords = std::uint32_t __attribute__((vector_size(4 * kLanes)));
using Corners = std::array<std::int64_t, kLanes>;  // index of a sample, for each lane

/// What reads two samples that follow each other along x, at eight places, as numbers counted from `zero`.
template <class T>
struct Pairs {
    std::int64_t step;
    double zero;
    [[gnu::always_inline]] void read(const T* row, const Corners& index, EightFloats& low, EightFloats& high) const {
        alignas(32) std::array<float, kLanes> lows, highs;
        for (std::size_t k = 0; k < kLanes; ++k) {
            const T *first = row + index[k], *second = first + step;
            lows[k] = static_cast<float>(static_cast<double>(*first) - zero);
            highs[k] = static_cast<float>(static_cast<double>(*second) - zero);
        }
        low = __builtin_bit_cast(EightFloats, lows), high = __builtin_bit_cast(EightFloats, highs);
    }
};

/// The same of small integers: both are one word. There are two or more along x.
template <class T>
struct SmallPairs {
    float zero;
    [[gnu::always_inline]] void read(const T* row, const Corners& index, EightFloats& low, EightFloats& high) const {
        const auto word = [&](std::size_t k) {
            std::conditional_t<sizeof(T) == 1, std::uint16_t, std::uint32_t> both;
            std::memcpy(&both, row + index[k], sizeof both);
            return std::uint32_t{both};
        };
        const EightWords both{word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7)};
        constexpr int kSize = 8 * sizeof(T), kFill = 32 - kSize;
        const EightWords lows = both << kFill, highs = both << (kFill - kSize);
        using Same = std::conditional_t<std::is_signed_v<T>, EightIntegers, EightWords>;  // the shift back keeps the sign
        const auto number = [&](const EightWords& high_bits, EightFloats& found) __attribute__((always_inline)) {
            found = __builtin_convertvector(__builtin_bit_cast(EightIntegers, __builtin_bit_cast(Same, high_bits) >> kFill), EightFloats) -
                    zero;
        };
        number(lows, low), number(highs, high);
    }
};

/// The same of floats: both are one word. A zero in single precision, two or more along x.
struct FloatPairs {
    float zero;
    [[gnu::always_inline]] void read(const float* row, const Corners& index, EightFloats& low, EightFloats& high) const {
        const auto word = [&](std::size_t k) {
            double both;
            std::memcpy(&both, row + index[k], sizeof both);
            return both;
        };
        const auto first = __builtin_bit_cast(EightFloats, FourDoubles{word(0), word(1), word(4), word(5)}),
                   second = __builtin_bit_cast(EightFloats, FourDoubles{word(2), word(3), word(6), word(7)});
        low = __builtin_shufflevector(first, second, 0, 2, 8, 10, 4, 6, 12, 14) - zero;
        high = __builtin_shufflevector(first, second, 1, 3, 9, 11, 5, 7, 13, 15) - zero;
    }
};

/// Between the corners of cells. corner: the first one. part: place in the cell, 0 to 1.
template <class T, class Reader>
[[gnu::always_inline]] inline void interpolate(const PlacedSamples<T>& samples, const Corners& corner, const Reader& pairs,
                                               const std::array<EightFloats, 3>& part, EightFloats& found) {
    std::array<EightFloats, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        EightFloats low, high;
        pairs.read(samples.first + (i & 1 ? samples.step[1] : 0) + (i & 2 ? samples.step[2] : 0), corner, low, high);
        rows[i] = low + part[0] * (high - low);
    }
    const EightFloats front = rows[0] + part[1] * (rows[1] - rows[0]), back = rows[2] + part[1] * (rows[3] - rows[2]);
    found = front + part[2] * (back - front);
}

/// The same, read in the way that fits T and the zero of the scale.
template <class T>
[[gnu::always_inline]] inline void interpolate(const PlacedSamples<T>& samples, const Corners& corner, double zero,
                                               const std::array<EightFloats, 3>& part, EightFloats& found) {
    if constexpr (sizeof(T) <= 2) {
        if (samples.step[0] != 0) return interpolate(samples, corner, SmallPairs<T>{static_cast<float>(zero)}, part, found);
    }
    if constexpr (std::is_same_v<T, float>) {
        const auto single = static_cast<float>(zero);
        if (samples.step[0] != 0 && static_cast<double>(single) == zero)
            return interpolate(samples, corner, FloatPairs{single}, part, found);
    }
    interpolate(samples, corner, Pairs<T>{samples.step[0], zero}, part, found);
}

/// The interpolant at eight places, less `zero`. Places outside are moved to the border.
template <class T>
[[gnu::always_inline]] inline void interpolate(const PlacedSamples<T>& samples, double zero, const std::array<EightFloats, 3>& places,
                                               EightFloats& found) {
    std::array<EightFloats, 3> part;
    std::array<EightIntegers, 3> cells;
    for (std::size_t a = 0; a < 3; ++a) {
        const EightFloats none{}, most = none + samples.last[a], from_zero = places[a] > none ? places[a] : none,
                                  place = from_zero < most ? from_zero : most;
        const EightIntegers cell = __builtin_convertvector(place, EightIntegers), most_cell = EightIntegers{} + samples.last_cell[a];
        cells[a] = cell < most_cell ? cell : most_cell;
        part[a] = place - __builtin_convertvector(cells[a], EightFloats);
    }
    Corners corner;
    for (std::size_t k = 0; k < kLanes; ++k) corner[k] = cells[0][k] + samples.stride[1] * cells[1][k] + samples.stride[2] * cells[2][k];
    interpolate(samples, corner, zero, part, found);
}

/// Negative central differences of the interpolant in a cell that has neighbours on all sides, from 12 rows of 4 samples along x: those at
/// y and y + 1, z and z + 1, and the ones beside them. part: place in the cell.
template <class T>
struct RowsAround {
    const T* first;  ///< corner 0 of the cell
    std::int64_t y, z;
    std::array<float, 3> part;

    [[gnu::always_inline]] void row(std::int64_t v, std::int64_t w, FourFloats& found) const {
        T __attribute__((vector_size(4 * sizeof(T)))) samples;
        std::memcpy(&samples, first - 1 + v * y + w * z, sizeof samples);
        found = __builtin_convertvector(samples, FourFloats);
    }
    [[gnu::always_inline]] void fall(Vec3& difference) const {
        std::array<std::array<FourFloats, 4>, 4> rows;  // by z, then y, both from -1 on
        for (int i = 0; i < 16; ++i) {
            const int v = i % 4, w = i / 4;
            const bool edge = (v == 0 || v == 3) && (w == 0 || w == 3);  // not needed
            if (!edge) row(v - 1, w - 1, rows[w][v]);
        }
        const auto mix = [](const auto& a, const auto& b, float t) __attribute__((always_inline)) { return a + t * (b - a); };
        const auto over_z = [&](int v)
                                __attribute__((always_inline)) { return mix(rows[0][v] - rows[2][v], rows[1][v] - rows[3][v], part[2]); };
        const auto over_y = [&](int w)
                                __attribute__((always_inline)) { return mix(rows[w][0] - rows[w][2], rows[w][1] - rows[w][3], part[1]); };
        const FourFloats line = mix(mix(rows[1][1], rows[1][2], part[1]), mix(rows[2][1], rows[2][2], part[1]), part[2]);
        const FourFloats along_y = mix(over_y(1), over_y(2), part[2]), along_z = mix(over_z(1), over_z(2), part[1]);
        difference[0] = 0.5 * static_cast<double>(mix(line[0] - line[2], line[1] - line[3], part[0]));
        difference[1] = 0.5 * static_cast<double>(mix(along_y[1], along_y[2], part[0]));
        difference[2] = 0.5 * static_cast<double>(mix(along_z[1], along_z[2], part[0]));
    }
};

/// Is the place in a cell that has neighbours on all sides? Then its rows.
template <class T>
[[gnu::always_inline]] inline bool find_rows(const PlacedSamples<T>& samples, const Vec3& place, RowsAround<T>& rows) {
    std::int64_t first = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto at = static_cast<float>(place[static_cast<int>(a)]);
        if (!(at >= 1 && at < samples.last[a] - 1)) return false;
        const auto cell = static_cast<std::int32_t>(at);
        rows.part[a] = at - static_cast<float>(cell);
        first += samples.stride[a] * cell;
    }
    rows.first = samples.first + first, rows.y = samples.stride[1], rows.z = samples.stride[2];
    return true;
}

}  // namespace

template <class T>
Trilinear<T>::Trilinear(const Volume& volume, const Transfer::Scale& scale)
    : samples_{volume.samples<T>().data(), {}, {}, {}, {}}, scale_(scale) {
    const Extent& extent = volume.info.extent;
    samples_.stride = {1, extent.size[0], extent.slice()};
    for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t size = extent.size[static_cast<int>(a)];
        samples_.last[a] = static_cast<float>(size - 1);
        samples_.last_cell[a] = static_cast<std::int32_t>(std::max<std::int64_t>(0, size - 2));
        samples_.step[a] = size > 1 ? samples_.stride[a] : 0;
    }
}

template <class T>
ISOATLAS_TARGET_CLONES void Trilinear<T>::places(const RaySegments& ray, std::int64_t segment, std::span<double, kLanes> t,
                                                 std::span<float, kLanes> found) const {
    std::array<std::array<FourFloats, 2>, 3> at;
    for (std::size_t half = 0; half < 2; ++half) {
        const FourDoubles numbers{1, 2, 3, 4}, begin = FourDoubles{} + ray.begin, end = FourDoubles{} + ray.end;
        const FourDoubles typed = (numbers + static_cast<double>(segment + static_cast<std::int64_t>(4 * half)) + ray.first) * ray.step,
                          late = typed > begin ? typed : begin, ends = late < end ? late : end;
        __builtin_memcpy(t.data() + 4 * half, &ends, sizeof ends);
        for (std::size_t a = 0; a < 3; ++a) {
            const FourDoubles along = ends * ray.way[static_cast<int>(a)] + ray.origin[static_cast<int>(a)];
            at[a][half] = __builtin_convertvector(along, FourFloats);
        }
    }
    std::array<EightFloats, 3> typed;
    for (std::size_t a = 0; a < 3; ++a) typed[a] = __builtin_shufflevector(at[a][0], at[a][1], 0, 1, 2, 3, 4, 5, 6, 7);
    EightFloats value;
    interpolate(samples_, scale_.zero, typed, value);
    const EightFloats scaled = value * static_cast<float>(scale_.factor), none{}, last = none + static_cast<float>(scale_.last),
                      from_zero = scaled > none ? scaled : none, place = from_zero < last ? from_zero : last;
    __builtin_memcpy(found.data(), &place, sizeof place);
}

template <class T>
ISOATLAS_TARGET_CLONES void Trilinear<T>::fall(const Vec3& place, Vec3& difference) const {
    if constexpr (sizeof(T) <= 2 || std::is_same_v<T, float>) {  // others have more digits than a float
        RowsAround<T> rows;
        if (find_rows(samples_, place, rows)) return rows.fall(difference);
    }
    // In front of the place and behind it, along each axis, kept inside by interpolate(); two lanes are not needed.
    constexpr std::array<EightFloats, 3> kShift{{{-1, 1, 0, 0, 0, 0, 0, 0}, {0, 0, -1, 1, 0, 0, 0, 0}, {0, 0, 0, 0, -1, 1, 0, 0}}};
    std::array<EightFloats, 3> places;
    for (std::size_t a = 0; a < 3; ++a) places[a] = kShift[a] + static_cast<float>(place[static_cast<int>(a)]);
    EightFloats found;
    interpolate(samples_, scale_.zero, places, found);
    for (int a = 0; a < 3; ++a) difference[a] = 0.5 * static_cast<double>(found[2 * a] - found[2 * a + 1]);
}

#define ISOATLAS_INSTANTIATE(T) template class Trilinear<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
