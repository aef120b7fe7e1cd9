#include "octree_front/leaf_loop.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

#include "base/check.h"
#include "field/cell_loops.h"

namespace isoatlas {
namespace {

/// From which edge to which the segment of an unsplit face runs, by the classes of its 4 corners alone.
struct FaceSegment {
    std::int8_t from = -1, to = -1;  ///< -1: there is none
};

const std::array<std::array<FaceSegment, 6>, 256>& face_segments() {
    static const auto table = [] {
        std::array<std::array<FaceSegment, 6>, 256> segments;
        for (int pattern = 0; pattern < 256; ++pattern) {
            for (int face = 0; face < 6; ++face) {
                const FaceLinks links = face_links(pattern, 0, face);
                if (links.count == 1)
                    segments[pattern][face] = {static_cast<std::int8_t>(links.link[0][0]), static_cast<std::int8_t>(links.link[0][1])};
            }
        }
        return segments;
    }();
    return table;
}

/// A hit in a leaf as a number, in the order of x, y, z, axis.
std::uint32_t number_of(const EdgeHit& hit, const Index3& first) {
    const Index3 at = hit.position - first;  // 0 .. 32 along each axis
    return static_cast<std::uint32_t>(((at[0] << 6 | at[1]) << 6 | at[2]) << 2 | hit.axis);
}
EdgeHit hit_of(std::uint32_t number, const Index3& first) {
    return {first + Index3{number >> 14, number >> 8 & 63, number >> 2 & 63}, static_cast<int>(number & 3)};
}
static_assert(1 << CoalescibleBlocks::kMaxLevel < 64);

/// Where it begins, and then where it ends: sorted by their beginnings.
std::uint64_t segment_of(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }

/// Is the block of the same level behind a face divided?
bool is_divided_across(const FrontLeaves& leaves, const FrontLeaf& leaf, int face) {
    if (leaf.level == 0) return false;
    const std::int64_t step = (face & 1) != 0 ? 1 : -1;
    const auto along = [&](std::size_t axis) {
        return leaf.block[axis] + (kFaceAxes[face / 2].normal == static_cast<int>(axis) ? step : 0);
    };
    return leaves.is_divided(leaf.level, {along(0), along(1), along(2)});
}

/// Adds the segments in a face of a leaf.
void add_segments(const FrontLeaves& leaves, const FrontLeaf& leaf, int face, std::vector<FrontLeaf>& pending,
                  std::vector<std::uint64_t>& found) {
    const CoalescibleBlocks& blocks = leaves.blocks();
    const int normal = kFaceAxes[face / 2].normal, side = face & 1;
    const Index3 first = leaf.position();
    pending.push_back(leaf);
    while (!pending.empty()) {
        const FrontLeaf part = pending.back();
        pending.pop_back();
        const FaceSegment segment = face_segments()[static_cast<std::size_t>(part.pattern)][static_cast<std::size_t>(face)];
        if (segment.from < 0) continue;  // nor has any part of this face one
        if (!is_divided_across(leaves, part, face)) {
            const auto end = [&](int edge) { return number_of(hit_on_edge(blocks, part, edge), first); };
            found.push_back(segment_of(end(segment.from), end(segment.to)));
            continue;
        }
        const std::array<std::uint8_t, 8> patterns = blocks.child_patterns(part.level, part.block);
        for (int child = 0; child < 8; ++child) {
            if ((child >> normal & 1) == side) pending.push_back(part.child(child, patterns[child]));
        }
    }
}

bool has_smaller_neighbour(const FrontLeaves& leaves, const FrontLeaf& leaf) {
    for (int face = 0; face < 6; ++face) {
        if (is_divided_across(leaves, leaf, face)) return true;
    }
    return false;
}

/// Bit i: the edge from vertex i to the next one is hit, of the edges of a line along an axis of a leaf.
std::uint64_t hits_along_x(const CoalescibleBlocks& blocks, const Index3& first, std::int64_t width) {
    const std::uint64_t row = blocks.vertex_bits(0, first);
    return (row ^ row >> 1) & ((std::uint64_t{1} << width) - 1);
}

/// By pattern: the axes, first that along which most corners become High, or Low.
const std::array<std::array<int, 3>, 256>& steepest_axes() {
    static const auto table = [] {
        std::array<std::array<int, 3>, 256> by_pattern;
        for (int pattern = 0; pattern < 256; ++pattern) {
            std::array<int, 3> slope{};  // how many more Highs there are on the far side
            for (int corner = 0; corner < 8; ++corner) {
                for (int axis = 0; axis < 3; ++axis) slope[axis] += (pattern >> corner & 1) * ((corner >> axis & 1) != 0 ? 1 : -1);
            }
            by_pattern[pattern] = {0, 1, 2};
            std::ranges::stable_sort(by_pattern[pattern], [&](int a, int b) { return std::abs(slope[a]) > std::abs(slope[b]); });
        }
        return by_pattern;
    }();
    return table;
}

/// The edge nearest to a vertex that is hit, of those of a line along an axis, from `first` on; the first one of two; -1: there is none.
std::int64_t nearest_hit(const CoalescibleBlocks& blocks, const Index3& first, int axis, std::int64_t width, std::int64_t vertex) {
    if (axis == 0) {
        const std::uint64_t hits = hits_along_x(blocks, first, width), before = hits & ((std::uint64_t{1} << vertex) - 1),
                            behind = hits ^ before;
        const std::int64_t left = before == 0 ? -1 : 63 - std::countl_zero(before), right = behind == 0 ? -1 : std::countr_zero(behind);
        if (left < 0 || right < 0) return std::max(left, right);
        return vertex - left <= right - vertex + 1 ? left : right;
    }
    const std::int64_t along_y = axis == 1 ? 1 : 0, along_z = 1 - along_y;
    const auto is_high = [&](std::int64_t i) { return blocks.is_high(0, first[0], first[1] + i * along_y, first[2] + i * along_z); };
    const bool own = is_high(vertex);
    for (std::int64_t away = 1; away <= std::max(vertex, width - vertex); ++away) {  // all that lie nearer are of one class
        if (away <= vertex && is_high(vertex - away) != own) return vertex - away;
        if (vertex + away <= width && is_high(vertex + away) != own) return vertex + away - 1;
    }
    return -1;
}

}  // namespace

EdgeHit hit_on_edge(const CoalescibleBlocks& blocks, const FrontLeaf& leaf, int edge) {
    const int corner = kEdgeCorners[edge][0], axis = edge / 4;
    std::int64_t x = leaf.block[0] + (corner & 1), y = leaf.block[1] + (corner >> 1 & 1), z = leaf.block[2] + (corner >> 2);
    if (axis == 0) {
        x <<= leaf.level, y <<= leaf.level, z <<= leaf.level;
        return {{x + std::countr_zero(hits_along_x(blocks, {x, y, z}, leaf.width())), y, z}, axis};
    }
    const bool is_high = (leaf.pattern >> corner & 1) != 0;
    const std::int64_t along_y = axis == 1 ? 1 : 0, along_z = 1 - along_y;
    for (int level = leaf.level; level-- > 0;) {
        x *= 2, y *= 2, z *= 2;
        if (blocks.is_high(level, x, y + along_y, z + along_z) == is_high) y += along_y, z += along_z;
    }
    return {{x, y, z}, axis};
}

void add_loop(const FrontLeaves& leaves, const FrontLeaf& leaf, std::vector<EdgeHit>& hits) {
    if (!has_smaller_neighbour(leaves, leaf)) {  // that of a cell with its corners
        const CellLoops& loop = cell_loops(leaf.pattern, 0);
        ISOATLAS_CHECK(loop.count == 1);
        for (int i = 0; i < loop.size(0); ++i) hits.push_back(hit_on_edge(leaves.blocks(), leaf, loop.edge[static_cast<std::size_t>(i)]));
        return;
    }
    thread_local std::vector<std::uint64_t> segments;
    thread_local std::vector<FrontLeaf> pending;
    segments.clear();
    for (int face = 0; face < 6; ++face) add_segments(leaves, leaf, face, pending, segments);
    std::ranges::sort(segments);
    const std::size_t end = hits.size() + segments.size();
    const auto begin = static_cast<std::uint32_t>(segments.front() >> 32);
    std::uint32_t next = begin;
    do {
        const auto segment = std::ranges::lower_bound(segments, segment_of(next, 0));
        ISOATLAS_CHECK(segment != segments.end() && *segment >> 32 == next && hits.size() < end);
        hits.push_back(hit_of(next, leaf.position()));
        next = static_cast<std::uint32_t>(*segment);
    } while (next != begin);
    ISOATLAS_CHECK(hits.size() == end);  // one loop
}

std::optional<EdgeHit> hit_inside(const CoalescibleBlocks& blocks, const FrontLeaf& leaf, std::span<const EdgeHit> loop) {
    const Index3 first = leaf.position();
    const std::int64_t width = leaf.width();
    Index3 sum{0, 0, 0};  // twice the places, so that the middles of edges are whole
    for (const EdgeHit& hit : loop) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum[axis] += 2 * (hit.position[axis] - first[axis]) + (hit.axis == static_cast<int>(axis));
    }
    Index3 middle;
    const auto count = static_cast<std::int64_t>(loop.size());
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = std::clamp<std::int64_t>((sum[axis] + count) / (2 * count), 1, width - 1);
    for (const int axis : steepest_axes()[static_cast<std::size_t>(leaf.pattern)]) {
        Index3 at = first + middle;
        at[axis] = first[axis];
        const std::int64_t nearest = nearest_hit(blocks, at, axis, width, middle[axis]);
        if (nearest < 0) continue;
        at[axis] += nearest;
        return EdgeHit{at, axis};
    }
    return std::nullopt;
}

}  // namespace isoatlas
