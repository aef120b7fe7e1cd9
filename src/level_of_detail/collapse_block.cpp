// Notation: an edge is named by the corner in whose triangle it runs from point to point, the lower number first; (gone, kept) becomes the
// point `kept` at the place where the sum of the quadrics is least. The heap holds edges with their costs; an entry whose cost is no
// longer that of its edge is old, a newer one is in the heap.
#include "level_of_detail/collapse_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "level_of_detail/distance_rule.h"
#include "level_of_detail/embedding_rule.h"
#include "level_of_detail/star.h"

namespace isoatlas {
namespace {

constexpr double kMinCosine = 0.2;  ///< between the normals of a triangle before and after
constexpr double kShape = 1e-4;     ///< what the length of an edge counts: flat parts get triangles of good shape

struct Entry {
    float cost;
    std::uint32_t corner;
};

bool is_later(const Entry& a, const Entry& b) { return std::tie(a.cost, a.corner) > std::tie(b.cost, b.corner); }

/// What an edge becomes.
struct Placement {
    float cost;
    std::uint32_t gone, kept;
    Vec3 scaled;
};

class BlockCollapser {
public:
    BlockCollapser(SurfaceState& state, const SurfaceBlock& block, const CollapseLimits& limits)
        : state_(state), mesh_(state.mesh), block_(block), limits_(limits), distance_(state.distance), embedding_(state) {}

    std::int64_t run(const CallerLooks& stop_if_asked) {
        constexpr int kLook = 1024;  ///< edges between looks
        embedding_.set_triangles(block_.inside, block_.crossing);
        for (const std::uint32_t t : block_.inside) {
            for (std::uint32_t k = 0; k < 3; ++k) add_edge(3 * t + k);
        }
        std::ranges::make_heap(heap_, is_later);
        is_heap_ = true;
        const auto before = static_cast<std::int64_t>(block_.inside.size());
        left_ = before;
        for (int edges = 0; !heap_.empty() && left_ >= limits_.triangles + 2; ++edges) {  // two at a time
            if (edges % kLook == 0) stop_if_asked();
            std::ranges::pop_heap(heap_, is_later);
            const Entry entry = heap_.back();
            heap_.pop_back();
            if (mesh_.has_triangle(entry.corner / 3)) take(entry);
        }
        return before - left_;
    }

private:
    [[nodiscard]] bool has_failed(std::uint32_t corner) const { return (state_.failed[corner / 3] >> (corner % 3) & 1U) != 0; }
    [[nodiscard]] bool is_at_rim(std::uint32_t point) const { return (state_.faces[point] & kRim) != 0; }

    /// Is this the corner that names its edge?
    [[nodiscard]] bool names_edge(std::uint32_t corner) const {
        const std::uint32_t a = mesh_.point(corner), b = mesh_.point(next_corner(corner));
        return a < b || (is_at_rim(a) && is_at_rim(b));  // an edge of the rim has one triangle
    }

    void add_edge(std::uint32_t corner) {
        if (has_failed(corner) || !names_edge(corner)) return;
        Placement placement;
        if (!place(corner, placement) || placement.cost > limits_.max_cost) return;
        heap_.push_back({placement.cost, corner});
        if (is_heap_) std::ranges::push_heap(heap_, is_later);
    }

    /// Where the edge is collapsed to, and at which cost; false where it may not be.
    bool place(std::uint32_t corner, Placement& placement) const {
        std::uint32_t gone = mesh_.point(corner), kept = mesh_.point(next_corner(corner));
        if (state_.locked[gone] || state_.locked[kept]) return false;
        const std::uint16_t faces_of_gone = state_.faces[gone], faces_of_kept = state_.faces[kept];
        const auto common = static_cast<std::uint16_t>(faces_of_gone & faces_of_kept);
        if (common != faces_of_gone && common != faces_of_kept) return false;
        if (faces_of_gone != common) std::swap(gone, kept);  // the one in more planes stays where it is
        const Vec3 &p = state_.scaled[gone], &q = state_.scaled[kept];
        const Vec3 middle{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2};
        Quadric<double> sum;
        add_quadric(sum, state_.quadrics[gone], minus(p, middle));
        add_quadric(sum, state_.quadrics[kept], minus(q, middle));
        Vec3 offset = least_of(sum);
        double cost = 0;
        if ((faces_of_gone | faces_of_kept) != 0) {
            offset = minus(q, middle);
            cost = error_at(sum, offset);
            const Vec3 other = minus(p, middle);
            if (faces_of_gone == faces_of_kept && error_at(sum, other) < cost) {
                std::swap(gone, kept);
                offset = other;
                cost = error_at(sum, other);
            }
        } else {
            cost = error_at(sum, offset);
        }
        const Vec3 along = minus(p, q);
        placement = {static_cast<float>(std::max(0.0, cost) + kShape * sum.area() * dot(along, along)), gone, kept, plus(middle, offset)};
        if ((faces_of_gone | faces_of_kept) != 0) placement.scaled = state_.scaled[placement.kept];
        return true;
    }

    void take(const Entry& entry) {
        Placement placement;
        if (!names_edge(entry.corner) || has_failed(entry.corner) || !place(entry.corner, placement) || placement.cost != entry.cost)
            return;
        if (may_collapse(placement)) {
            collapse(placement);
        } else {
            std::uint8_t& failed = state_.failed[entry.corner / 3];
            failed = static_cast<std::uint8_t>(failed | 1U << (entry.corner % 3));
        }
    }

    bool may_collapse(const Placement& placement) {
        const auto [cost, gone, kept, scaled] = placement;
        if (!block_.holds(scaled) || !star_.find(mesh_, gone, kept, is_at_rim(gone) && is_at_rim(kept))) return false;
        star_.gone_scaled = state_.scaled[gone], star_.kept_scaled = state_.scaled[kept];
        star_.gone_point = state_.points[gone], star_.kept_point = state_.points[kept];
        star_.new_scaled = scaled;
        star_.new_point = state_.frame->physical(scaled);
        if (scaled == star_.kept_scaled) star_.new_point = star_.kept_point;
        state_.scaled[kept] = star_.new_scaled;
        state_.points[kept] = star_.new_point;
        const bool may = keeps_normals() && (!state_.distance.original || distance_.holds(star_, state_)) && embedding_.holds(star_);
        if (!may) state_.scaled[kept] = star_.kept_scaled, state_.points[kept] = star_.kept_point;
        return may;
    }

    [[nodiscard]] bool keeps_normals() const {
        return std::ranges::all_of(star_.triangles, [&](const StarTriangle& t) {
            if (t.disappears) return true;
            const Vec3 &b = state_.scaled[t.b], side = minus(state_.scaled[t.c], b);
            const Vec3 before = cross(side, minus(t.apex == star_.gone ? star_.gone_scaled : star_.kept_scaled, b));
            const Vec3 now = cross(side, minus(star_.new_scaled, b));
            const double lengths = std::sqrt(dot(before, before) * dot(now, now));
            return dot(now, now) > 0 && (lengths > 0 ? dot(before, now) > kMinCosine * lengths : true);
        });
    }

    void collapse(const Placement& placement) {
        const auto [cost, gone, kept, scaled] = placement;
        Quadric<double> sum;
        add_quadric(sum, state_.quadrics[gone], minus(star_.gone_scaled, scaled));
        add_quadric(sum, state_.quadrics[kept], minus(star_.kept_scaled, scaled));
        state_.quadrics[kept] = rounded(sum);
        state_.faces[kept] = static_cast<std::uint16_t>(state_.faces[kept] | state_.faces[gone]);
        mesh_.collapse(gone, kept);
        for (const StarTriangle& t : star_.triangles) left_ -= t.disappears ? 1 : 0;
        embedding_.commit();
        if (state_.distance.original) distance_.commit(star_);
        for (const StarTriangle& t : star_.triangles) add_edges_of_new_point(t);
        for (const std::uint32_t point : star_.ring) retry_edges_of(point);
    }

    void add_edges_of_new_point(const StarTriangle& t) {
        if (t.disappears) return;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = 3 * t.number + k;
            if (mesh_.point(corner) != star_.kept && mesh_.point(next_corner(corner)) != star_.kept) continue;
            clear_failed(corner);
            add_edge(corner);
        }
    }

    /// Its triangles are others now: what had failed may not fail again.
    void retry_edges_of(std::uint32_t point) {
        mesh_.for_fan(point, [&](std::uint32_t corner) {
            for (const std::uint32_t of_edge : {corner, last_corner(corner)}) {
                if (!has_failed(of_edge)) continue;
                clear_failed(of_edge);
                add_edge(of_edge);
            }
        });
    }
    void clear_failed(std::uint32_t corner) {
        std::uint8_t& failed = state_.failed[corner / 3];
        failed = static_cast<std::uint8_t>(failed & ~(1U << (corner % 3)));
    }

    SurfaceState& state_;
    CollapsibleMesh& mesh_;
    const SurfaceBlock& block_;
    const CollapseLimits limits_;
    DistanceRule distance_;
    EmbeddingRule embedding_;
    std::vector<Entry> heap_;
    bool is_heap_ = false;
    std::int64_t left_ = 0;
    Star star_;
};

}  // namespace

std::int64_t collapse_block(SurfaceState& state, const SurfaceBlock& block, const CollapseLimits& limits,
                            const CallerLooks& stop_if_asked) {
    BlockCollapser collapser(state, block, limits);
    return collapser.run(stop_if_asked);
}

}  // namespace isoatlas
