// Batches of hits, whose points and normals are computed by vector code.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "base/target_clones.h"
#include "mesh/physical_map.h"

namespace isoatlas {

/// Pending hits on edges along one axis.
struct HitBatch {
    std::size_t count = 0;
    Lanes<std::int32_t> from{};                ///< first end of the edge, in a bundle of rows (mesh/bundle_samples.h)
    std::array<std::int64_t, kLanes> point{};  ///< where the hit is written
    bool is_at_end = false;                    ///< does one of them look beyond an end of its row?

    /// Is there no room for a word of hits, and for what a vector writes behind its last one?
    [[nodiscard]] bool is_full() const { return count > kLanes - 64 - 16; }
};

/// Values computed for a batch.
template <class Real>
struct HitValues {
    std::array<Real, kLanes> a{}, b{};      ///< samples at the ends of the edge
    Lanes<Real> slope{}, change{};          ///< of the samples at the first end, and what it changes by towards the other one
    std::array<double, kLanes> t{};         ///< where the hit lies between them
    Lanes<double> place{};                  ///< of the hit
    std::array<bool, kLanes> degenerate{};  ///< PhysicalMap::to_normals
};

/// Where the hits of a run lie: on edges that begin at samples of a row.
struct HitRun {
    std::int32_t x;  ///< sample of bit 0
    std::int32_t y, z;
    std::int64_t point;  ///< of the first hit
};

/// Appends a hit for every bit set. Returns how many.
inline std::int64_t append_plain(const HitRun& run, std::uint64_t bits, HitBatch& batch) {
    std::int64_t point = run.point;
    for (; bits != 0; bits &= bits - 1) {
        const std::size_t i = batch.count++;
        batch.from[0][i] = run.x + std::countr_zero(bits), batch.from[1][i] = run.y, batch.from[2][i] = run.z;
        batch.point[i] = point++;
    }
    return point - run.point;
}

#if ISOATLAS_HAS_AVX512
/// The same for 16 hits at a time, without unpredictable branches.
ISOATLAS_AVX512 inline std::int64_t append_avx512(const HitRun& run, std::uint64_t bits, HitBatch& batch) {
    alignas(64) static constexpr std::array<std::uint8_t, 64> kPositions = [] {
        std::array<std::uint8_t, 64> positions{};
        for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<std::uint8_t>(i);
        return positions;
    }();
    const int hits = std::popcount(bits);
    const std::size_t end = batch.count + static_cast<std::size_t>(hits);
    __m512i positions = _mm512_maskz_compress_epi8(bits, _mm512_load_si512(kPositions.data()));
    __m512i point = _mm512_add_epi64(_mm512_set1_epi64(run.point), _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0));
    std::size_t i = batch.count;
    do {
        const __m512i x = _mm512_add_epi32(_mm512_set1_epi32(run.x),
                                           _mm512_maskz_cvtepu8_epi32(0xffff, _mm512_maskz_extracti32x4_epi32(0xf, positions, 0)));
        _mm512_storeu_si512(batch.from[0].data() + i, x);
        _mm512_storeu_si512(batch.from[1].data() + i, _mm512_set1_epi32(run.y));
        _mm512_storeu_si512(batch.from[2].data() + i, _mm512_set1_epi32(run.z));
        _mm512_storeu_si512(batch.point.data() + i, point);
        point = _mm512_add_epi64(point, _mm512_set1_epi64(8));
        _mm512_storeu_si512(batch.point.data() + i + 8, point);
        point = _mm512_add_epi64(point, _mm512_set1_epi64(8));
        positions = _mm512_maskz_alignr_epi32(0xffff, _mm512_setzero_si512(), positions, 4);
        i += 16;
    } while (i < end);
    batch.count = end;
    return hits;
}
#endif

/// append_plain(), by AVX-512 where the processor has it.
inline std::int64_t append(const HitRun& run, std::uint64_t bits, HitBatch& batch) {
#if ISOATLAS_HAS_AVX512
    if (kHasAvx512) return append_avx512(run, bits, batch);
#endif
    return append_plain(run, bits, batch);
}

}  // namespace isoatlas
