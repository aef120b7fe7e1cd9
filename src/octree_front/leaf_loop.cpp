#include "octree_front/leaf_loop.h"

#include <algorithm>
#include <array>

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

struct Segment {
    EdgeHit from, to;
};

/// Is the block of the same level behind a face divided?
bool is_divided_across(const FrontLeaves& leaves, const FrontLeaf& leaf, int face) {
    const int normal = kFaceAxes[face / 2].normal;
    Index3 across = leaf.block;
    across[normal] += (face & 1) != 0 ? 1 : -1;
    return leaf.level > 0 && across[normal] >= 0 && across[normal] < leaves.blocks().blocks(leaf.level)[normal] &&
           leaves.is_divided(leaf.level, across);
}

/// Adds the segments in a face of a leaf.
void add_segments(const FrontLeaves& leaves, const FrontLeaf& leaf, int face, std::vector<FrontLeaf>& pending,
                  std::vector<Segment>& found) {
    const int normal = kFaceAxes[face / 2].normal, side = face & 1;
    pending.push_back(leaf);
    while (!pending.empty()) {
        const FrontLeaf part = pending.back();
        pending.pop_back();
        if (is_divided_across(leaves, part, face)) {
            for (int child = 0; child < 8; ++child) {
                if ((child >> normal & 1) != side) continue;
                pending.push_back(part.child(child));
            }
            continue;
        }
        const int pattern = leaves.blocks().pattern(part.level, part.block);
        const FaceSegment segment = face_segments()[static_cast<std::size_t>(pattern)][static_cast<std::size_t>(face)];
        if (segment.from < 0) continue;
        found.push_back({hit_on_edge(leaves.blocks(), part.level, part.block, segment.from),
                         hit_on_edge(leaves.blocks(), part.level, part.block, segment.to)});
    }
}

bool has_smaller_neighbour(const FrontLeaves& leaves, const FrontLeaf& leaf) {
    for (int face = 0; face < 6; ++face) {
        if (is_divided_across(leaves, leaf, face)) return true;
    }
    return false;
}

bool is_before(const EdgeHit& a, const EdgeHit& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (a.position[axis] != b.position[axis]) return a.position[axis] < b.position[axis];
    }
    return a.axis < b.axis;
}

}  // namespace

EdgeHit hit_on_edge(const CoalescibleBlocks& blocks, int level, const Index3& block, int edge) {
    const int corner = kEdgeCorners[edge][0], axis = edge / 4;
    Index3 first{(block[0] + (corner & 1)) << level, (block[1] + (corner >> 1 & 1)) << level, (block[2] + (corner >> 2)) << level};
    const bool is_high = level > 0 && blocks.is_high(first);
    for (std::int64_t width = std::int64_t{1} << level >> 1; width > 0; width /= 2) {
        Index3 middle = first;
        middle[axis] += width;
        if (blocks.is_high(middle) == is_high) first = middle;
    }
    return {first, axis};
}

void find_loop(const FrontLeaves& leaves, const FrontLeaf& leaf, std::vector<EdgeHit>& hits) {
    if (!has_smaller_neighbour(leaves, leaf)) {  // that of a cell with its corners
        const CellLoops& loop = cell_loops(leaves.blocks().pattern(leaf.level, leaf.block), 0);
        ISOATLAS_CHECK(loop.count == 1);
        hits.clear();
        for (int i = 0; i < loop.size(0); ++i)
            hits.push_back(hit_on_edge(leaves.blocks(), leaf.level, leaf.block, loop.edge[static_cast<std::size_t>(i)]));
        return;
    }
    thread_local std::vector<Segment> segments;
    thread_local std::vector<FrontLeaf> pending;
    segments.clear();
    for (int face = 0; face < 6; ++face) add_segments(leaves, leaf, face, pending, segments);
    std::ranges::sort(segments, [](const Segment& a, const Segment& b) { return is_before(a.from, b.from); });
    hits.clear();
    EdgeHit next = segments.front().from;
    do {
        const auto segment = std::ranges::lower_bound(segments, next, is_before, &Segment::from);
        ISOATLAS_CHECK(segment != segments.end() && segment->from == next && hits.size() < segments.size());
        hits.push_back(next);
        next = segment->to;
    } while (!(next == hits.front()));
    ISOATLAS_CHECK(hits.size() == segments.size());  // one loop
}

std::optional<EdgeHit> hit_inside(const CoalescibleBlocks& blocks, const FrontLeaf& leaf, const std::vector<EdgeHit>& loop) {
    const Index3 first = leaf.position();
    const std::int64_t width = leaf.width();
    const int pattern = blocks.pattern(leaf.level, leaf.block);
    std::array<int, 3> slope{};  // how many more Highs there are on the far side
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) slope[axis] += (pattern >> corner & 1) * ((corner >> axis & 1) != 0 ? 1 : -1);
    }
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::stable_sort(axes, [&](int a, int b) { return std::abs(slope[a]) > std::abs(slope[b]); });
    Index3 sum{0, 0, 0};  // twice the places, so that the middles of edges are whole
    for (const EdgeHit& hit : loop) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum[axis] += 2 * (hit.position[axis] - first[axis]) + (hit.axis == static_cast<int>(axis));
    }
    Index3 middle;
    const auto count = static_cast<std::int64_t>(loop.size());
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = std::clamp<std::int64_t>((sum[axis] + count) / (2 * count), 1, width - 1);
    for (const int axis : axes) {
        std::int64_t best = -1, nearest = 4 * width;
        Index3 at = first + middle;
        at[axis] = first[axis];
        bool is_high = blocks.is_high(at);
        for (std::int64_t i = 0; i < width; ++i) {
            at[axis] = first[axis] + i + 1;
            const bool next = blocks.is_high(at);
            const std::int64_t away = std::abs(2 * i + 1 - 2 * middle[axis]);
            if (next != is_high && away < nearest) best = i, nearest = away;
            is_high = next;
        }
        if (best < 0) continue;
        at[axis] = first[axis] + best;
        return EdgeHit{at, axis};
    }
    return std::nullopt;
}

}  // namespace isoatlas
