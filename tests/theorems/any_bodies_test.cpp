// Any body points make a consistent topology (docs/theory/6-interior.md#body-points): which faces are exceptional and where their body
// points lie may be wrong, as rounding makes them wrong, as long as regions and order are those of a tunnel.
//
// This program replaces bodies_of_cell and the faces it is told, for the library and for the oracle alike, by some that throw dice: a face
// that could end a tunnel does so or not, whatever the interpolant says, and the body point lies anywhere up to where its regions end.
#define bodies_of_cell bodies_of_the_interpolant
#define disagreeing_faces faces_of_the_interpolant
#include "critical/bodies.cpp"
#undef bodies_of_cell
#undef disagreeing_faces

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <random>

#include "isoatlas/isoatlas.h"
#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace isoatlas {
namespace {

std::uint64_t seed_of_dice = 0;
std::atomic<std::int64_t> bodies_thrown = 0, bodies_moved = 0;

/// The same throws for the same cell, whoever asks.
std::mt19937_64 dice_of(const CellElements& cell) {
    std::uint64_t hash = seed_of_dice;
    for (const double v : cell.value) hash = (hash ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0x9e3779b97f4a7c15U + (hash >> 29);
    return std::mt19937_64(hash);
}

double any_value_above(double low, double high, std::mt19937_64& dice) {
    if (dice() % 3 == 0) return std::numeric_limits<double>::max();  // where the regions end
    return low + (high - low) * std::uniform_real_distribution<>(0, 1)(dice);
}

std::optional<BodyPoint> any_opening(const CellView& cell, double top, unsigned faces, std::mt19937_64& dice) {
    for (unsigned rest = faces; rest != 0; rest &= rest - 1) {
        const int f = std::countr_zero(rest);
        if (dice() % 2 == 0) continue;
        const std::optional<BodyPoint> body = place(cell, {any_value_above(cell.value(8 + f), top, dice), {0.5, 0.5, 0.5}}, f);
        if (body) return body;
    }
    return std::nullopt;
}

}  // namespace

DisagreeingFaces disagreeing_faces(const CellElements& cell, unsigned default_types) {
    return {cell.ambiguous & ~default_types, cell.ambiguous & default_types};  // any could end a tunnel
}

CellBodies bodies_of_cell(const CellElements& cell, const DisagreeingFaces& faces, double tunnel_height) {
    const unsigned default_types = faces.closings;
    CellBodies bodies;
    std::mt19937_64 dice = dice_of(cell);
    if (!std::isfinite(tunnel_height) || cell.ambiguous == 0 || dice() % 4 == 0) return bodies;
    const CellView upright(cell, false), upside_down(cell, true);
    const auto [lowest, highest] = std::minmax_element(cell.value.begin(), cell.value.end());
    bodies.opening = any_opening(upright, *highest, faces.openings, dice);
    bodies.closing = any_opening(upside_down, -*lowest, faces.closings, dice);
    if (bodies.closing) bodies.closing->value = -bodies.closing->value;
    if (bodies.opening && bodies.closing) {
        const bool in_order =
            bodies.closing->value >= bodies.opening->value && upright.is_above(8 + bodies.closing->face, 8 + bodies.opening->face);
        if (!in_order) (dice() % 2 == 0 ? bodies.opening : bodies.closing).reset();
    }
    for (const std::optional<BodyPoint>& body : {bodies.opening, bodies.closing}) {
        if (body) bodies.exceptional |= 1U << body->face;
    }
    bodies_thrown += std::popcount(bodies.exceptional);
    bodies_moved += std::popcount(bodies.exceptional & ~bodies_of_the_interpolant(cell, default_types, 0).exceptional);
    return bodies;
}

}  // namespace isoatlas

namespace oracle {
namespace {

using isoatlas::Interpolant;

isoatlas::Context one_thread() {
    isoatlas::Context context;
    context.threads = 1;
    return context;
}

void throw_dice() { isoatlas::seed_of_dice = *rc::gen::arbitrary<std::uint64_t>(); }

// At every cut: T1, T2, and what elements, levels, events, zones and arcs say.
void any_bodies_trees_equal_the_oracle() {
    throw_dice();
    const Grid grid = *arbitrary_grid(6, 80);
    const Result expected = analyse(elements_of(grid, Interpolant::trilinear));
    RC_ASSERT(expected.consistent);
    const std::string difference = compare(expected, isoatlas::analyse(to_volume(grid), {.interpolant = Interpolant::trilinear}));
    RC_ASSERT(difference == "");
}

void any_bodies_cuts_equal_the_oracle() {
    throw_dice();
    const Grid grid = *arbitrary_grid(4, 36);
    const Elements elements = elements_of(grid, Interpolant::trilinear);
    const isoatlas::Volume volume = to_volume(grid);
    for (const double tau : interesting_values(elements)) {
        const std::string difference =
            compare_cut(elements, tau, isoatlas::cut(volume, tau, {.interpolant = Interpolant::trilinear, .label = true}, one_thread()));
        RC_ASSERT(difference == "");
    }
}

void any_bodies_tree_cut_and_mesh_agree() {
    throw_dice();
    const isoatlas::Volume volume = to_volume(*arbitrary_grid(6, 100));
    for (const isoatlas::CheckResult& check :
         isoatlas::verify_volume(volume, {.levels = 12, .interpolant = Interpolant::trilinear}, one_thread())) {
        if (!check.holds) RC_FAIL(check.name + ": " + check.detail);
    }
}

TEST(AnyBodies, WereThrownAndDifferFromThoseOfTheInterpolant) {  // else this program would prove nothing
    isoatlas::bodies_thrown = isoatlas::bodies_moved = 0;
    const isoatlas::Volume noise = isoatlas::make_phantom("noise", {.size = 12});
    EXPECT_GT(isoatlas::analyse(noise, {.interpolant = Interpolant::trilinear}).element_count(), 0);
    EXPECT_GT(isoatlas::bodies_thrown, 200);
    EXPECT_GT(isoatlas::bodies_moved, 100);
}

RC_GTEST_PROP(AnyBodies, TreesEqualTheOracle, ()) { any_bodies_trees_equal_the_oracle(); }
RC_GTEST_PROP(AnyBodies, CutsEqualTheOracle, ()) { any_bodies_cuts_equal_the_oracle(); }
RC_GTEST_PROP(AnyBodies, TreeCutAndMeshAgree, ()) { any_bodies_tree_cut_and_mesh_agree(); }

}  // namespace
}  // namespace oracle
