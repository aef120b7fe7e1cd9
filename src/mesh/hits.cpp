#include "mesh/hits.h"

#include <algorithm>
#include <bit>
#include <string>

#include "base/sample_types.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kLongestRow = (std::int64_t{1} << 31) - 128;  // positions in a batch of hits are 32 bits

std::int64_t strips_of(const Extent& extent) { return (extent.size[1] + kBundleSize[1] - 1) / kBundleSize[1]; }

template <class Visit>
void for_bits(std::uint64_t bits, Visit&& visit) {
    for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

}  // namespace

template <class T>
HitWriter<T>::HitWriter(const SampleGrid<T>& grid, double tau, const PhysicalMap& map, const MeshDomain& domain, Surface& surface)
    : grid_(grid), tau_(tau), map_(map), domain_(domain), surface_(surface), normals_(!surface.normals.empty()) {
    if (grid.extent.size[0] > kLongestRow) {
        throw Error(ErrorKind::resource, {.where = "axis x",
                                          .what = "a row has " + std::to_string(grid.extent.size[0]) + " samples",
                                          .expected = "at most " + std::to_string(kLongestRow) + " for a surface",
                                          .next = "crop the volume, or let its longest axis be y or z"});
    }
    for (int axis = 0; axis < 3; ++axis) border_normal_[axis] = {map.normal(Vec3{0, 0, 0}, axis, -1), map.normal(Vec3{0, 0, 0}, axis, 1)};
}

template <class T>
std::int64_t HitWriter<T>::bundles() const {
    return strips_of(grid_.extent) * ((grid_.extent.size[2] + kBundleSize[2] - 1) / kBundleSize[2]);
}

template <class T>
void HitWriter<T>::write(std::int64_t bundle, const Layout& layout, const RowGroups& groups) const {
    const std::int64_t strips = strips_of(grid_.extent), first_y = bundle % strips * kBundleSize[1],
                       first_z = bundle / strips * kBundleSize[2];
    const std::int64_t end_y = std::min(first_y + kBundleSize[1], grid_.extent.size[1]),
                       end_z = std::min(first_z + kBundleSize[2], grid_.extent.size[2]);
    std::optional<Work> work;
    std::vector<Row> rows;
    rows.reserve(static_cast<std::size_t>(kBundleSize[1]));
    for (std::int64_t z = first_z; z < end_z; ++z) {
        if (z + kSlicesAhead < end_z && groups.is_used(RowGroups::group_of(first_y), z + kSlicesAhead))
            prefetch_rows(domain_, layout, first_y, end_y, z + kSlicesAhead);
        if (!groups.is_used(RowGroups::group_of(first_y), z)) continue;
        rows.clear();
        for (std::int64_t y = first_y; y < end_y; ++y) {
            const RowOffsets& place = layout[domain_.row_number(y, z)];
            if (place.x_hits + place.y_hits + place.z_hits == 0) continue;
            rows.emplace_back(RowHits(domain_, y, z, place), place, y - first_y, z - first_z, y + 1 == grid_.extent.size[1],
                              z + 1 == grid_.extent.size[2]);
        }
        if (rows.empty()) continue;
        if (!work) {
            work.emplace(Work{BundleSamples<T, Real>(grid_, map_), position(0, first_y, first_z), {}, {}});
            work->samples.move_to(first_y, first_z);
        }
        write_slice(rows, *work);
    }
    for (std::size_t axis = 0; work && axis < 3; ++axis) flush(axis, *work);
}

template <class T>
void HitWriter<T>::write_lines(std::int64_t y, std::int64_t z, std::span<const HitLine> lines) const {
    const std::int64_t first_y = std::max<std::int64_t>(y, 0), first_z = std::max<std::int64_t>(z, 0);
    Work work{BundleSamples<T, Real>(grid_, map_), position(0, first_y, first_z), {}, {}};
    work.samples.move_to(first_y, first_z);
    for (const HitLine& line : lines) write_line(line, line.y - first_y, line.z - first_z, work);
    for (std::size_t axis = 0; axis < 3; ++axis) flush(axis, work);
}

template <class T>
void HitWriter<T>::write_line(const HitLine& line, std::int64_t y, std::int64_t z, Work& work) const {
    const std::size_t axis = line.axis;
    const std::int64_t last = grid_.extent.size[0];  // position of the last voxel
    HitBatch& batch = work.batch[axis];
    std::int64_t point = line.point;
    for (const std::int32_t p : line.positions) {
        Index3 from{p - 1, line.y, line.z}, to = from;
        ++to[axis];
        if (from[axis] < 0 || to[axis] == grid_.extent.size[axis]) {
            const bool is_behind = from[axis] >= 0;
            const Index3& voxel = is_behind ? from : to;
            write_border(position(voxel[0], voxel[1], voxel[2]), static_cast<int>(axis), is_behind ? 1 : -1, point++);
            continue;
        }
        if (batch.is_full()) flush(axis, work);
        batch.is_at_end = batch.is_at_end || p == 1 || p >= last - 1;
        const std::size_t i = batch.count++;
        batch.from[0][i] = p - 1, batch.from[1][i] = static_cast<std::int32_t>(y), batch.from[2][i] = static_cast<std::int32_t>(z);
        batch.point[i] = point++;
    }
}

template <class T>
void HitWriter<T>::write_slice(std::vector<Row>& rows, Work& work) const {
    for (std::int64_t i = 0; i < rows.front().hits.candidates.size; ++i) {
        std::uint64_t candidates = 0;
        for (const Row& row : rows) candidates |= row.hits.candidates.bits[i];
        for_bits(candidates, [&](int bit) {
            for (Row& row : rows) {
                if ((row.hits.candidates.bits[i] >> bit & 1) != 0) write_word(64 * i + bit, row, work);
            }
        });
    }
}

template <class T>
void HitWriter<T>::write_word(std::int64_t w, Row& row, Work& work) const {
    const std::array<std::uint64_t, 3> bits{row.hits.x(w), row.hits.y(w), row.hits.z(w)};
    if ((bits[0] | bits[1] | bits[2]) == 0) return;
    const std::uint64_t any = bits[0] | bits[1] | bits[2];
    work.samples.prefetch_around(64 * w - 1 + std::countr_zero(any), 64 * w + 62 - std::countl_zero(any), row.y, row.z);
    std::uint64_t inner_x = bits[0];
    if (w == 0 && (inner_x & 1) != 0) {  // between the padding and the first voxel
        write_border({work.first[0], work.first[1] + row.y, work.first[2] + row.z}, 0, -1, row.next[0]++);
        inner_x &= ~std::uint64_t{1};
    }
    const std::int64_t last = grid_.extent.size[0];  // position of the last voxel
    const std::array<std::uint64_t, 3> border{w == last / 64 ? inner_x & std::uint64_t{1} << last % 64 : 0, row.is_last_y ? bits[1] : 0,
                                              row.is_last_z ? bits[2] : 0};
    const std::array<std::uint64_t, 3> inner{inner_x ^ border[0], bits[1] ^ border[1], bits[2] ^ border[2]};
    const bool is_at_end = ((inner[0] | inner[1] | inner[2]) & end_positions(w)) != 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        HitBatch& batch = work.batch[axis];
        if (batch.is_full()) flush(axis, work);
        batch.is_at_end = batch.is_at_end || is_at_end;
        row.next[axis] += append({static_cast<std::int32_t>(64 * w - 1), row.y, row.z, row.next[axis]}, inner[axis], batch);
        // Where the row's next hits are written, so that stores do not miss the cache either.
        prefetch_to_write(surface_.points.data() + row.next[axis]);
        if (normals_) prefetch_to_write(surface_.normals.data() + row.next[axis]);
    }
    if ((border[0] | border[1] | border[2]) == 0) return;
    for (std::size_t axis = 0; axis < 3; ++axis) write_ends(w, border[axis], axis, row, work);
}

template <class T>
std::uint64_t HitWriter<T>::end_positions(std::int64_t w) const {
    const std::int64_t last = grid_.extent.size[0];
    if (w > 0 && w < (last - 1) / 64) return 0;
    std::uint64_t ends = w == 0 ? 2 : 0;
    for (const std::int64_t p : {last - 1, last}) ends |= p / 64 == w ? std::uint64_t{1} << p % 64 : 0;
    return ends;
}

template <class T>
void HitWriter<T>::normals_of(std::size_t axis, Work& work) const {
    const BundleSamples<T, Real>& samples = work.samples;
    const HitBatch& batch = work.batch[axis];
    if (!batch.is_at_end && samples.has_same_scales()) return compute_normals(batch, map_, samples.same_scales(), work.values);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < batch.count; ++i) {
            const std::int32_t at = batch.from[k][i], next = at + (axis == k);
            work.values.slope[k][i] *= samples.scale(k, at);
            work.values.change[k][i] *= samples.scale(k, next);
        }
    }
    compute_normals(batch, map_, {1, 1, 1}, work.values);
}

template <class T>
void HitWriter<T>::flush(std::size_t axis, Work& work) const {
    HitBatch& batch = work.batch[axis];
    HitValues<Real>& values = work.values;
    work.samples.gather(batch, axis, normals_, values);
    place_hits(batch, axis, tau_, map_, work.first, values);
    if (normals_) normals_of(axis, work);
    for (std::size_t i = 0; i < batch.count; ++i)
        surface_.points[batch.point[i]] = {values.place[0][i], values.place[1][i], values.place[2][i]};
    const auto& [x, y, z] = values.slope;
    for (std::size_t i = 0; normals_ && i < batch.count; ++i) {
        surface_.normals[batch.point[i]] =
            values.degenerate[i] ? map_.degenerate_normal({static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])},
                                                          static_cast<int>(axis), values.a[i] > values.b[i] ? 1 : -1)
                                 : std::array{static_cast<float>(x[i]), static_cast<float>(y[i]), static_cast<float>(z[i])};
    }
    batch.count = 0;
    batch.is_at_end = false;
}

template <class T>
void HitWriter<T>::write_ends(std::int64_t w, std::uint64_t bits, std::size_t axis, Row& row, const Work& work) const {
    for_bits(bits, [&](int bit) {
        const Vec3 at{work.first[0] + static_cast<double>(64 * w + bit - 1), work.first[1] + row.y, work.first[2] + row.z};
        write_border(at, static_cast<int>(axis), 1, row.next[axis]++);
    });
}

template <class T>
void HitWriter<T>::write_border(const Vec3& position, int axis, double sign, std::int64_t point) const {
    Vec3 outside = position;
    outside[axis] += sign * kHitMargin;
    surface_.points[point] = map_.point(outside);
    if (normals_) surface_.normals[point] = border_normal_[axis][sign > 0 ? 1 : 0];
}

template <class T>
void HitWriter<T>::write_outside(std::int64_t y, std::int64_t z, const RowOffsets& place) const {
    const RowHits hits(domain_, y, z);
    std::int64_t y_point = place.first_y(), z_point = place.first_z();
    hits.candidates.for_each([&](std::int64_t w) {
        for_bits(hits.y(w), [&](int bit) { write_border(position(64 * w + bit - 1, y + 1, z), 1, -1, y_point++); });
        for_bits(hits.z(w), [&](int bit) { write_border(position(64 * w + bit - 1, y, z + 1), 2, -1, z_point++); });
    });
}

#define ISOATLAS_INSTANTIATE(T) template class HitWriter<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas
