#include "critical/scan.h"

#include <bit>
#include <cmath>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "critical/bodies.h"
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

/// The cells between slices z and z+1: adds the types of their ambiguous faces to the slice buffers.
/// A slice buffer counts, per voxel and orientation (2 bits each), the cells in which the face has type H.
template <class T>
class LayerTypes {
public:
    LayerTypes(const GridView<T>& grid, double tunnel_height)
        : grid_(grid), steps_(grid.extent), offset_(corner_offsets(steps_)), tunnel_height_(tunnel_height), any_(grid.extent.size[0] + 8) {}

    /// bodies: where body points go; null: they belong to another slab.
    void add(std::int64_t z, const Bytes& faces, const Bytes& faces_next, Bytes& high, Bytes& high_next, SlabScan* bodies) {
        bodies_ = bodies;
        const std::int64_t n = grid_.extent.size[0];
        for (std::int64_t y = 0; y + 1 < grid_.extent.size[1]; ++y) {
            const std::int64_t base = y * n;
            gather_row(faces.data() + base, faces_next.data() + base, n);
            for (std::int64_t x = 0; x + 1 < n; x += 8) {
                std::uint64_t block;
                std::memcpy(&block, any_.data() + x, 8);
                while (block != 0) {
                    const int byte = std::countr_zero(block) / 8;
                    block &= ~(std::uint64_t{0xff} << (8 * byte));
                    if (x + byte + 1 < n) add_cell(base + x + byte, z, faces, faces_next, high, high_next);
                }
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

    void add_cell(std::int64_t i, std::int64_t z, const Bytes& faces, const Bytes& next, Bytes& high, Bytes& high_next) {
        const std::int64_t n = grid_.extent.size[0];
        const T* corner = grid_.slice(z) + i;
        CellElements cell;
        for (int k = 0; k < 8; k += 2) set_pair(&cell.value[k], corner[offset_[k]], corner[offset_[k] + 1]);
        for (int k = 0; k < 8; ++k) cell.voxel[k] = z * grid_.extent.slice() + i + offset_[k];
        // Bits 2o of a face byte are face 2o of the cell; the faces on the far sides belong to the neighbours behind.
        const auto far = [&](int mine, int of_next, int of_y, int of_x) {
            return static_cast<unsigned>((mine & 0b010101) | (of_next & 0b000001) << 1 | (of_y & 0b000100) << 1 | (of_x & 0b010000) << 1);
        };
        const int mine = faces[i], of_next = next[i], of_y = faces[i + n], of_x = faces[i + 1];
        cell.ambiguous = far(mine | mine >> 1, of_next | of_next >> 1, of_y | of_y >> 1, of_x | of_x >> 1);
        cell.bd_high = far(mine >> 1, of_next >> 1, of_y >> 1, of_x >> 1);
        const EstimatedTypes found = kIsSmall<T> ? default_types_of_small(cell, table_) : estimate_default_types(cell, table_);
        unsigned types = found.types;
        if (std::isfinite(tunnel_height_)) types ^= add_bodies(cell, types, found.has_face_values);
        high[i] += static_cast<std::uint8_t>(types & 0b010101);
        high_next[i] += static_cast<std::uint8_t>(types >> 1 & 0b000001);
        high[i + n] += static_cast<std::uint8_t>(types >> 1 & 0b000100);
        high[i + 1] += static_cast<std::uint8_t>(types >> 1 & 0b010000);
    }

    /// Returns the faces whose type is not the default one.
    unsigned add_bodies(CellElements& cell, unsigned types, bool has_exact_faces) {
        const DisagreeingFaces faces = disagreeing_faces(cell, types);
        if (!faces.any()) return 0;
        if (!has_exact_faces) find_face_values(cell);
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

/// Appends the critical elements of one slice.
template <class T>
class Emitter {
public:
    explicit Emitter(const GridView<T>& grid) : grid_(grid), steps_(grid.extent) {}

    void slice(std::int64_t z, std::span<const std::uint8_t> links, const Bytes& faces, const Bytes& high, SlabScan& out) const {
        const std::array<VertexType, 64>& types = kVertexTypes[grid_.extent.rank];
        const std::int64_t first = z * grid_.extent.slice();
        for (std::size_t i = 0; i < links.size(); ++i) {
            const VertexType type = types[links[i]];
            if (type.critical) vertex(first + static_cast<std::int64_t>(i), type, out);
            if (faces[i] != 0) faces_of_voxel(first + static_cast<std::int64_t>(i), faces[i], high[i], out);
        }
    }

private:
    void vertex(std::int64_t voxel, VertexType type, SlabScan& out) const {
        out.maxima += type.h0 == 0;
        out.minima += type.l0 == 0;
        out.add({static_cast<double>(grid_.samples[voxel]), ElementCode::vertex(voxel, type.h0, type.l0, type.axis)});
    }

    void faces_of_voxel(std::int64_t voxel, int faces, int high, SlabScan& out) const {
        // Two bits a face: in how many of its cells it has type H. One: one side joins the Highs, the other the Lows: regular in 3D.
        const int ambiguous = (faces | faces >> 1) & 0b010101;
        const int critical = grid_.is_3d() ? ambiguous & ~high : ambiguous;
        for (unsigned rest = static_cast<unsigned>(critical); rest != 0; rest &= rest - 1) {
            const int bit = std::countr_zero(rest);
            const bool closes = high >> (bit + 1) & 1;
            const int h0 = !grid_.is_3d() || !closes ? 2 : 1, l0 = !grid_.is_3d() || closes ? 2 : 1;
            face(voxel, bit / 2, faces >> (bit + 1) & 1 ? Diagonal::bd : Diagonal::ac, h0, l0, out);
        }
    }

    void face(std::int64_t voxel, int orientation, Diagonal diagonal, int h0, int l0, SlabScan& out) const {
        std::array<T, 4> v;
        for (int i = 0; i < 4; ++i) v[i] = grid_.samples[voxel + steps_.face_corner(orientation, i)];
        const double s = disambiguation_value(v[0], v[1], v[2], v[3], diagonal);
        const bool bd_high = diagonal == Diagonal::bd;
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
};

}  // namespace

template <class T>
SlabScan scan_slab(const GridView<T>& grid, Slab slab, std::span<std::uint8_t> links, double tunnel_height) {
    const std::int64_t slice = grid.extent.slice(), slices = grid.extent.size[2];
    Bytes faces(slice), faces_next(slice), high(slice), high_next(slice);
    LayerTypes<T> layer(grid, tunnel_height);
    const Emitter<T> emit(grid);
    SlabScan out;
    // The layer below the slab decides one side of the xy faces of the first slice.
    const std::int64_t first_layer = slab.z_begin > 0 ? slab.z_begin - 1 : 0;
    bool any = faces_of_slice(grid, first_layer, first_layer + 1 < slices, faces);
    for (std::int64_t z = first_layer; z < slab.z_end; ++z) {
        const bool has_next = z + 1 < slices;
        const bool any_next = has_next && faces_of_slice(grid, z + 1, z + 1 < slab.z_end && z + 2 < slices, faces_next);
        if (has_next && (any || any_next)) layer.add(z, faces, faces_next, high, high_next, z >= slab.z_begin ? &out : nullptr);
        if (z >= slab.z_begin) {
            const std::span<std::uint8_t> slice_links = links.subspan((z - slab.z_begin) * slice, slice);
            links_of_slice(grid, z, slice_links);
            emit.slice(z, slice_links, faces, high, out);
        }
        faces.swap(faces_next);
        high.swap(high_next);
        std::fill(high_next.begin(), high_next.end(), std::uint8_t{0});
        any = any_next;
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
