// T8 (docs/theory/8-noise-and-stability.md#what-is-stable): samples that differ by at most eps. Samples, eps and isovalues are multiples of
// a power of two, so that their sums are exact; saddles are rounded once, downwards, so comparisons with such isovalues are exact too.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::EventId;

struct Neighbours {
    Grid f, g;
    double eps;
    isoatlas::Interpolant interpolant;
};

/// f, and g with |f - g| <= eps.
Neighbours arbitrary_neighbours() {
    Neighbours both{*arbitrary_grid(), {}, *rc::gen::element(0.5, 4.0, 30.0), *arbitrary_interpolant()};
    for (double& value : both.f.value) value = std::round(16 * value) / 16;
    both.g = both.f;
    for (double& value : both.g.value) value += *rc::gen::inRange(-8, 9) / 8.0 * both.eps;
    return both;
}

Analysis analysis_of(const Grid& grid, isoatlas::Interpolant interpolant) {
    return isoatlas::analyse(to_volume(grid), {.interpolant = interpolant});
}

/// The object of a voxel at an isovalue, as an event; none: Low.
EventId object_at(const Analysis& analysis, const Grid& grid, Index voxel, double tau) {
    if (grid.value[voxel] < tau) return EventId::none();
    EventId event = analysis.zone(isoatlas::VoxelId(voxel));
    while (analysis.event(event).zone.tau_low >= tau) event = analysis.event(event).parent;
    return event;
}

/// Does every object of `inner` at tau + eps lie in one object of `outer` at tau?
void expect_nested(const Grid& inner, const Grid& outer, double tau, double eps, const Analysis& of_inner, const Analysis& of_outer) {
    std::map<EventId, EventId> around;  // by object of inner
    for (Index v = 0; v < inner.voxels(); ++v) {
        const EventId object = object_at(of_inner, inner, v, tau + eps);
        if (!object.exists()) continue;
        const EventId found = object_at(of_outer, outer, v, tau);
        RC_ASSERT(found.exists());
        RC_ASSERT(around.emplace(object, found).first->second == found);
    }
}

void objects_of_neighbours_are_nested(const Neighbours& both) {
    const Analysis f = analysis_of(both.f, both.interpolant), g = analysis_of(both.g, both.interpolant);
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(f.event_count())) {
        for (const double below : {0.0, 1 / 64.0, both.eps, 2 * both.eps}) {
            const double tau = std::round(64 * (f.event(i).value - below)) / 64;
            expect_nested(both.f, both.g, tau, both.eps, f, g);
            expect_nested(both.g, both.f, tau, both.eps, g, f);
        }
    }
}

struct Pair {
    double birth, death;
    [[nodiscard]] bool is_near(const Pair& other, double distance) const {
        return std::abs(birth - other.birth) <= distance && (death == other.death || std::abs(death - other.death) <= distance);
    }
};

/// Births and deaths of all objects: where several meet the one of the highest maximum lives on.
std::vector<Pair> pairs_by_the_elder_rule(const Analysis& analysis) {
    std::vector<Pair> pairs;
    std::vector<double> birth;
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        const isoatlas::Event event = analysis.event(i);
        birth.push_back(event.children.empty() ? event.value : -kInfinity);
        for (const EventId child : event.children) birth.back() = std::max(birth.back(), birth[child.index()]);
        bool is_eldest_seen = false;
        for (const EventId child : event.children) {
            const double of_child = birth[child.index()];
            if (of_child == birth.back() && !is_eldest_seen) {
                is_eldest_seen = true;
            } else {
                pairs.push_back({of_child, event.value});
            }
        }
    }
    pairs.push_back({birth.back(), -kInfinity});
    return pairs;
}

/// A partner in `to` for one of `from`: augmenting paths (Kuhn). partner: per pair of `to`, in `from`; -1: none yet.
bool finds_partner(const std::vector<Pair>& from, const std::vector<Pair>& to, double distance, std::size_t of, std::vector<bool>& seen,
                   std::vector<int>& partner) {
    for (std::size_t k = 0; k < to.size(); ++k) {
        if (seen[k] || !from[of].is_near(to[k], distance)) continue;
        seen[k] = true;
        if (partner[k] >= 0 && !finds_partner(from, to, distance, static_cast<std::size_t>(partner[k]), seen, partner)) continue;
        partner[k] = static_cast<int>(of);
        return true;
    }
    return false;
}

/// Has every pair of `from` with a persistence above 2 eps a partner of its own in `to`?
bool long_pairs_have_partners(const std::vector<Pair>& from, const std::vector<Pair>& to, double eps) {
    constexpr double kRounding = 1e-9;  // of saddles
    std::vector<int> partner(to.size(), -1);
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::vector<bool> seen(to.size(), false);
        if (from[i].birth - from[i].death > 2 * eps + kRounding && !finds_partner(from, to, eps + kRounding, i, seen, partner))
            return false;
    }
    return true;
}

// Where both directions have partners there is one matching that serves both (Mendelsohn, Dulmage 1958).
void persistence_pairs_move_by_at_most_eps(const Neighbours& both) {
    const std::vector<Pair> f = pairs_by_the_elder_rule(analysis_of(both.f, both.interpolant)),
                            g = pairs_by_the_elder_rule(analysis_of(both.g, both.interpolant));
    RC_ASSERT(long_pairs_have_partners(f, g, both.eps));
    RC_ASSERT(long_pairs_have_partners(g, f, both.eps));
}

RC_GTEST_PROP(Theorem, T8_ObjectsOfNearbySamplesAreNested, ()) { objects_of_neighbours_are_nested(arbitrary_neighbours()); }
RC_GTEST_PROP(Theorem, T8_PersistencePairsMoveByAtMostEps, ()) { persistence_pairs_move_by_at_most_eps(arbitrary_neighbours()); }

// The test of T8 notices an object that is not there, and one that has moved.
TEST(PersistencePairs, WithoutAPartnerAreFound) {
    const std::vector<Pair> two{{10, -kInfinity}, {8, 2}};
    EXPECT_TRUE(long_pairs_have_partners(two, {{11, -kInfinity}, {7, 3}}, 1));
    EXPECT_FALSE(long_pairs_have_partners(two, {{11, -kInfinity}, {7, 3.5}}, 1));
    EXPECT_FALSE(long_pairs_have_partners(two, {{10, -kInfinity}}, 1));
    EXPECT_TRUE(long_pairs_have_partners(two, {{10, -kInfinity}}, 3));         // its persistence is 6
    EXPECT_FALSE(long_pairs_have_partners({{10, 0}, {10, 0}}, {{10, 0}}, 1));  // a partner serves one
}

}  // namespace
}  // namespace oracle
