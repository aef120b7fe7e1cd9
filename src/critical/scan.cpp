#include "critical/scan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "critical/bodies.h"
#include "critical/face_rows.h"
#include "critical/faces.h"
#include "critical/links.h"

namespace isoatlas {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Offsets from the first corner of a cell to its corners, in voxels.
std::array<std::int64_t, 8> corner_offsets(const GridSteps& steps) {
    std::array<std::int64_t, 8> offsets{};
    for (int k = 0; k < 8; ++k) offsets[k] = (k & 1) * steps.axis[0] + (k >> 1 & 1) * steps.axis[1] + (k >> 2) * steps.axis[2];
    return offsets;
}

/// Two values at once: they are loaded as a pair, which would wait for two stores.
template <class T>
inline void set_pair(double* pair, T first, T second) {
#ifdef __SSE2__
    _mm_store_pd(pair, _mm_set_pd(static_cast<double>(second), static_cast<double>(first)));
#else
    pair[0] = static_cast<double>(first), pair[1] = static_cast<double>(second);
#endif
}

/// The cells between slices z and z+1: counts, for every ambiguous face, the cells in which it has type H.
template <class T>
class LayerTypes {
public:
    LayerTypes(const GridView<T>& grid, double tunnel_height)
        : grid_(grid), steps_(grid.extent), offset_(corner_offsets(steps_)), tunnel_height_(tunnel_height), any_(grid.extent.size[0] + 8) {}

    /// Of the cells of row y. bodies: where body points go; null: they belong to another slab.
    void add_row(std::int64_t y, std::int64_t z, SliceFaces& lower, SliceFaces& upper, const FaceRows<T>& values, SlabScan* bodies) {
        bodies_ = bodies;
        const std::int64_t n = grid_.extent.size[0], base = y * n;
        gather_row(lower.faces.data() + base, upper.faces.data() + base, n);
        for (std::int64_t x = 0; x + 1 < n; x += 8) {
            std::uint64_t block;
            std::memcpy(&block, any_.data() + x, 8);
            while (block != 0) {
                const int byte = std::countr_zero(block) / 8;
                block &= ~(std::uint64_t{0xff} << (8 * byte));
                if (x + byte + 1 < n) add_cell(x + byte, base, z, lower, upper, values);
            }
        }
    }

private:
    void gather_row(const std::uint8_t* faces, const std::uint8_t* next, std::int64_t n) {
        for (std::int64_t x = 0; x + 1 < n; ++x) {
            any_[x] = static_cast<std::uint8_t>(faces[x] | (faces[x + n] & kFaceBits[1]) | (faces[x + 1] & kFaceBits[2]) |
                                                (next[x] & kFaceBits[0]));
        }
    }

    void add_cell(std::int64_t x, std::int64_t row, std::int64_t z, SliceFaces& lower, SliceFaces& upper, const FaceRows<T>& values) {
        const std::int64_t n = grid_.extent.size[0], i = row + x;
        const T* corner = grid_.slice(z) + i;
        CellElements cell;
        for (int k = 0; k < 8; k += 2) set_pair(&cell.value[k], corner[offset_[k]], corner[offset_[k] + 1]);
        for (int k = 0; k < 8; ++k) cell.voxel[k] = z * grid_.extent.slice() + i + offset_[k];
        cell.face_value = values.of_cell(x);
        cell.has_small_integers = kIsSmall<T>;
        // Bits 2o of a face byte are face 2o of the cell; the faces on the far sides belong to the neighbours behind.
        const auto far = [&](int mine, int of_next, int of_y, int of_x) {
            return static_cast<unsigned>((mine & 0b010101) | (of_next & 0b000001) << 1 | (of_y & 0b000100) << 1 | (of_x & 0b010000) << 1);
        };
        const int mine = lower.faces[i], of_next = upper.faces[i], of_y = lower.faces[i + n], of_x = lower.faces[i + 1];
        cell.ambiguous = far(mine | mine >> 1, of_next | of_next >> 1, of_y | of_y >> 1, of_x | of_x >> 1);
        cell.bd_high = far(mine >> 1, of_next >> 1, of_y >> 1, of_x >> 1);
        unsigned types = default_face_types(cell, table_);
        if (std::isfinite(tunnel_height_)) types ^= add_bodies(cell, types);
        lower.high[i] += static_cast<std::uint8_t>(types & 0b010101);
        upper.high[i] += static_cast<std::uint8_t>(types >> 1 & 0b000001);
        lower.high[i + n] += static_cast<std::uint8_t>(types >> 1 & 0b000100);
        lower.high[i + 1] += static_cast<std::uint8_t>(types >> 1 & 0b010000);
    }

    /// Returns the faces whose type is not the default one.
    unsigned add_bodies(const CellElements& cell, unsigned types) {
        const DisagreeingFaces faces = disagreeing_faces(cell, types);
        if (!faces.any()) return 0;
        const CellBodies found = bodies_of_cell(cell, faces, tunnel_height_);
        if (found.exceptional == 0 || bodies_ == nullptr) return found.exceptional;
        for (const CodeKind kind : {CodeKind::body_open, CodeKind::body_close}) {
            const std::optional<BodyPoint>& body = kind == CodeKind::body_open ? found.opening : found.closing;
            if (body) bodies_->add({body->value, ElementCode::body(kind, cell.voxel[0], body->region_a, body->region_b, body->ring)});
        }
        return found.exceptional;
    }

    const GridView<T>& grid_;
    GridSteps steps_;
    std::array<std::int64_t, 8> offset_;
    double tunnel_height_;
    const CellTable& table_ = cell_table();
    Bytes any_;
    SlabScan* bodies_ = nullptr;
};

/// Appends the critical elements of one row.
template <class T>
class Emitter {
public:
    explicit Emitter(const GridView<T>& grid) : grid_(grid), steps_(grid.extent), types_(kVertexTypes[grid.extent.rank]) {
        for (std::size_t links = 0; links < types_.size(); ++links) is_critical_ |= std::uint64_t{types_[links].critical} << links;
    }

    /// links, faces, high: of its voxels.
    void row(std::int64_t first, std::span<const std::uint8_t> links, const std::uint8_t* faces, const std::uint8_t* high,
             const FaceRows<T>& values, SlabScan& out) const {
        for (std::size_t begin = 0; begin < links.size(); begin += kTogether) {
            const std::size_t count = std::min(links.size() - begin, kTogether);
            const std::uint32_t some = count == kTogether ? which_are_significant<kTogether>(links.data() + begin, faces + begin, count)
                                                          : which_are_significant<0>(links.data() + begin, faces + begin, count);
            for (std::uint32_t rest = some; rest != 0; rest &= rest - 1) {
                const std::size_t x = begin + static_cast<std::size_t>(std::countr_zero(rest));
                const std::int64_t i = first + static_cast<std::int64_t>(x);
                if ((is_critical_ >> links[x] & 1) != 0) vertex(i, types_[links[x]], out);
                if (faces[x] == 0) continue;
                faces_of_voxel(i, faces[x], high[x], [&](int o) { return values.mine(static_cast<std::int64_t>(x), o); }, out);
            }
        }
    }

private:
    static constexpr std::size_t kTogether = 32;  // most voxels are regular

    /// Bit k: voxel k is critical or has an ambiguous face. Count, where it is not 0, is known to the compiler.
    template <std::size_t Count>
    [[nodiscard]] std::uint32_t which_are_significant(const std::uint8_t* links, const std::uint8_t* faces, std::size_t count) const {
        std::uint32_t some = 0;
        for (std::size_t k = 0; k < (Count != 0 ? Count : count); ++k) {
            some |= static_cast<std::uint32_t>((is_critical_ >> links[k] & 1) | unsigned{faces[k] != 0}) << k;
        }
        return some;
    }

    void vertex(std::int64_t voxel, VertexType type, SlabScan& out) const {
        out.maxima += type.h0 == 0;
        out.minima += type.l0 == 0;
        out.add({static_cast<double>(grid_.samples[voxel]), ElementCode::vertex(voxel, type.h0, type.l0, type.axis)});
    }

    template <class Values>
    void faces_of_voxel(std::int64_t voxel, int faces, int high, const Values& values, SlabScan& out) const {
        // Two bits a face: in how many of its cells it has type H. One: one side joins the Highs, the other the Lows: regular in 3D.
        const int ambiguous = (faces | faces >> 1) & 0b010101;
        const int critical = grid_.is_3d() ? ambiguous & ~high : ambiguous;
        for (unsigned rest = static_cast<unsigned>(critical); rest != 0; rest &= rest - 1) {
            const int bit = std::countr_zero(rest);
            const bool closes = high >> (bit + 1) & 1;
            const int h0 = !grid_.is_3d() || !closes ? 2 : 1, l0 = !grid_.is_3d() || closes ? 2 : 1;
            face(voxel, bit / 2, (faces >> (bit + 1) & 1) != 0, values(bit / 2), h0, l0, out);
        }
    }

    void face(std::int64_t voxel, int orientation, bool bd_high, double s, int h0, int l0, SlabScan& out) const {
        std::array<T, 4> v;
        for (int i = 0; i < 4; ++i) v[i] = grid_.samples[voxel + steps_.face_corner(orientation, i)];
        // Highest Low of the same value: voxel numbers ascend a < b < d < c.
        int tie = 0;
        for (const int low : bd_high ? std::array{0, 2} : std::array{1, 3}) {
            if (static_cast<double>(v[low]) == s) tie = low + 1;
        }
        if (!bd_high && static_cast<double>(v[1]) == s && static_cast<double>(v[3]) == s) tie = 4;  // d lies behind b
        out.add({s, ElementCode::face(3 * voxel + orientation, tie, bd_high, h0, l0)});
    }

    const GridView<T>& grid_;
    GridSteps steps_;
    const std::array<VertexType, 64>& types_;  // of the links of a vertex
    std::uint64_t is_critical_ = 0;            // bit: of links
};

}  // namespace

template <class T>
SlabScan scan_slab(const GridView<T>& grid, Slab slab, std::span<std::uint8_t> links, double tunnel_height) {
    const std::int64_t n = grid.extent.size[0], rows = grid.extent.size[1], slice = grid.extent.slice(), slices = grid.extent.size[2];
    SliceFaces lower(slice), upper(slice);
    FaceRows<T> values(grid);
    LayerTypes<T> layer(grid, tunnel_height);
    const Emitter<T> emit(grid);
    SlabScan out;
    const auto find_faces = [&](SliceFaces& of, std::int64_t z, bool with_next) {
        return faces_of_slice(grid, z, with_next, std::span(of.faces).first(slice));
    };
    // The layer below the slab decides one side of the xy faces of the first slice.
    const std::int64_t first_layer = slab.z_begin > 0 ? slab.z_begin - 1 : 0;
    lower.any = find_faces(lower, first_layer, first_layer + 1 < slices);
    for (std::int64_t z = first_layer; z < slab.z_end; ++z) {
        const bool has_next = z + 1 < slices, is_ours = z >= slab.z_begin;
        upper.any = has_next && find_faces(upper, z + 1, z + 1 < slab.z_end && z + 2 < slices);
        const bool has_cells = has_next && (lower.any || upper.any);
        if (is_ours) links_of_slice(grid, z, links.subspan((z - slab.z_begin) * slice, slice));
        for (std::int64_t y = 0; y < rows; ++y) {
            if (has_cells || lower.any) values.find(y, z, lower, upper, has_cells);
            if (has_cells && y + 1 < rows) layer.add_row(y, z, lower, upper, values, is_ours ? &out : nullptr);
            if (!is_ours) continue;
            const std::int64_t row = y * n;
            emit.row(z * slice + row, links.subspan((z - slab.z_begin) * slice + row, n), lower.faces.data() + row, lower.high.data() + row,
                     values, out);
        }
        std::swap(lower, upper);
        std::fill(upper.high.begin(), upper.high.end(), std::uint8_t{0});
    }
    return out;
}

template SlabScan scan_slab(const GridView<std::uint8_t>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<std::int8_t>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<std::uint16_t>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<std::int16_t>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<std::uint32_t>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<std::int32_t>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<float>&, Slab, std::span<std::uint8_t>, double);
template SlabScan scan_slab(const GridView<double>&, Slab, std::span<std::uint8_t>, double);

}  // namespace isoatlas
