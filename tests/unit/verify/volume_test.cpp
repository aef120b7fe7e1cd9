// verify_volume: holds on random volumes; and every check of the analysis notices when the analysis is damaged.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "analysis/analysis_data.h"
#include "isoatlas/isoatlas.h"
#include "verify/slice_checks.h"
#include "verify/tree_checks.h"

namespace isoatlas {
namespace {

Volume random_volume(int rank) {
    const auto size = [] { return *rc::gen::inRange<std::int64_t>(1, 6); };
    const Extent extent{rank, {size(), size(), rank == 2 ? 1 : size()}};
    const int top = *rc::gen::element(2, 4, 16, 256);
    const auto values = *rc::gen::container<std::vector<std::uint8_t>>(
        static_cast<std::size_t>(extent.voxels()),
        rc::gen::map(rc::gen::inRange(0, top), [](int v) { return static_cast<std::uint8_t>(v); }));
    return make_volume<std::uint8_t>(extent, values);
}

void expect_all_hold(const Volume& volume) {
    Context context;
    context.threads = 1;
    for (const CheckResult& check : verify_volume(volume, {.levels = 9}, context)) {
        if (!check.holds) RC_FAIL(check.name + ": " + check.detail);
    }
}

RC_GTEST_PROP(VerifyVolume, HoldsIn3D, ()) { expect_all_hold(random_volume(3)); }
RC_GTEST_PROP(VerifyVolume, HoldsIn2D, ()) { expect_all_hold(random_volume(2)); }

TEST(VerifyVolume, ConstantAndSingleVoxel) {
    for (const Extent& extent : {Extent{3, {4, 3, 2}}, Extent{3, {1, 1, 1}}, Extent{2, {3, 3, 1}}}) {
        for (const CheckResult& check : verify_volume(make_volume(extent, ValueType::f64), {.levels = 4}))
            EXPECT_TRUE(check.holds) << check.name << ": " << check.detail;
    }
}

TEST(VerifyVolume, IsovaluesAreDataValuesAndValuesBetween) {
    const Volume volume = make_phantom("noise", {.size = 6});
    const std::vector<double> chosen = isovalues_to_check(volume, 8);
    ASSERT_EQ(chosen.size(), 8U);
    std::map<bool, int> is_data;
    for (const double tau : chosen) {
        bool data = false;
        for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) data = data || volume.value(i) == tau;
        ++is_data[data];
    }
    EXPECT_GE(is_data[true], 4);
    EXPECT_GE(is_data[false], 3);
}

/// The figure of the dissertation: maxima, merges, genus changes, a split with a cavity, a minimum.
class Damaged : public testing::Test {
protected:
    using Arrays = AnalysisArrays<std::uint32_t>;
    Arrays& arrays() { return std::get<0>(const_cast<Analysis::Data&>(analysis_.data()).arrays)->arrays; }

    const Volume volume_ = make_phantom("figure-plateau", {});
    Analysis analysis_ = analyse(volume_);
};

TEST_F(Damaged, WholeItHolds) {
    EXPECT_TRUE(join_tree_is_valid(analysis_).holds);
    EXPECT_TRUE(zones_partition_voxels(analysis_, volume_).holds);
    EXPECT_TRUE(euler_sums_hold(analysis_).holds);
    EXPECT_TRUE(contour_tree_is_a_tree(analysis_).holds);
    EXPECT_TRUE(levels_match_events(analysis_).holds);
}

TEST_F(Damaged, AWrongParentIsFound) {
    arrays().tree.parent[EventId(2)] =
        EventIdOf<std::uint32_t>(4);  // event 4 is on another branch, of lower value: voxels and chi do not add up any more
    EXPECT_FALSE(euler_sums_hold(analysis_).holds);
}

TEST_F(Damaged, AParentAboveItsChildIsFound) {
    arrays().tree.parent[EventId(7)] = EventIdOf<std::uint32_t>(6);
    EXPECT_FALSE(join_tree_is_valid(analysis_).holds);
}

TEST_F(Damaged, AVoxelInTheWrongZoneIsFound) {
    arrays().zone[VoxelId(0)] = 0;
    const CheckResult check = zones_partition_voxels(analysis_, volume_);
    EXPECT_FALSE(check.holds);
    EXPECT_NE(check.detail.find("voxel 0 "), std::string::npos) << check.detail;
}

TEST_F(Damaged, AWrongVoxelCountIsFound) {
    ++arrays().voxels[EventId(3)];
    EXPECT_FALSE(zones_partition_voxels(analysis_, volume_).holds);
    EXPECT_FALSE(euler_sums_hold(analysis_).holds);
}

TEST_F(Damaged, AWrongEulerNumberIsFound) {
    ++arrays().measures.chi[EventId(5)];
    EXPECT_FALSE(euler_sums_hold(analysis_).holds);
}

TEST_F(Damaged, AWrongGenusIsFound) {
    for (auto& half_chi : arrays().contours.half_chi.items()) half_chi -= 1;
    EXPECT_FALSE(euler_sums_hold(analysis_).holds);
    Check check("contour_tree_equals_cut");
    compare_arcs_and_cut(analysis_, cut(volume_, 57), check);
    EXPECT_FALSE(check.holds());
}

TEST_F(Damaged, AnArcToAnotherElementIsFound) {
    ++arrays().contours.other[ElementId(0)];
    EXPECT_FALSE(contour_tree_is_a_tree(analysis_).holds);
}

TEST_F(Damaged, AnElementInTheWrongLevelIsFound) {
    arrays().level[ElementId(1)] = ElementIdOf<std::uint32_t>(0);
    const CheckResult check = contour_tree_is_a_tree(analysis_);
    EXPECT_FALSE(check.holds);
    EXPECT_NE(check.detail.find("element 1 "), std::string::npos) << check.detail;
}

TEST_F(Damaged, AnElementOutsideTheZoneOfItsEventIsFound) {
    arrays().tree.event_of_element.items().back() = EventIdOf<std::uint32_t>(0);
    EXPECT_FALSE(join_tree_is_valid(analysis_).holds);
}

TEST_F(Damaged, AWrongEventOfALevelIsFound) {
    auto& event_of_element = arrays().tree.event_of_element.items();
    std::swap(event_of_element.front(), event_of_element.back());
    EXPECT_FALSE(levels_match_events(analysis_).holds);
}

class Compared : public Damaged {
protected:
    bool tree_agrees(const Cut& at) {
        Check check("tree_equals_cut");
        compare_tree_and_cut(
            analysis_, TreeAtLevels(analysis_, {at.tau}), 0, at, [&](VoxelId voxel) { return analysis_.zone(voxel); }, check);
        return check.holds();
    }
    bool mesh_agrees(const Cut& at, const Surface& surface) {
        Check check("cut_equals_mesh");
        compare_cut_and_mesh(at, surface, inspect(surface.points, surface.triangles), check);
        return check.holds();
    }

    const double tau_ = 57;  // a ring with one tunnel
};

TEST_F(Compared, TreeAndCutAgreeUntilOneIsWrong) {
    const Cut right = cut(volume_, tau_);
    EXPECT_TRUE(tree_agrees(right));
    Cut wrong = right;
    wrong.objects[0].b1 += 1;
    EXPECT_FALSE(tree_agrees(wrong));
    wrong = right;
    wrong.contours[0].genus += 1;
    EXPECT_FALSE(tree_agrees(wrong));
    wrong = right;
    wrong.objects.pop_back();
    EXPECT_FALSE(tree_agrees(wrong));
    wrong = right;
    for (CutObject& object : wrong.objects) object.id = right.objects[0].id;  // one object twice
    EXPECT_FALSE(tree_agrees(wrong));
}

TEST_F(Compared, CutAndMeshAgreeUntilOneIsWrong) {
    const Cut right = cut(volume_, tau_);
    const Surface surface = extract(volume_, tau_);
    EXPECT_TRUE(mesh_agrees(right, surface));
    Cut wrong = right;
    wrong.contours[0].genus += 1;
    EXPECT_FALSE(mesh_agrees(wrong, surface));
    wrong = right;
    wrong.contours.pop_back();
    EXPECT_FALSE(mesh_agrees(wrong, surface));
    wrong = right;
    wrong.contours[0].id += 1;
    EXPECT_FALSE(mesh_agrees(wrong, surface));
    EXPECT_FALSE(mesh_agrees(right, extract(volume_, tau_, {.surface = {.objects = {right.objects[0].id}, .contours = {}}})));
}

TEST_F(Compared, CurvesAreClosedAndCounted) {
    const std::vector<std::uint8_t> ring{1, 1, 1, 1, 0, 1, 1, 1, 1};
    const Volume flat = make_volume<std::uint8_t>({2, {3, 3, 1}}, ring);
    const Cut at = cut(flat, 0.5);
    Surface curves = extract(flat, 0.5);
    const auto agrees = [&](const Surface& surface) {
        Check check("cut_equals_mesh");
        compare_cut_and_curves(at, surface, check);
        return check.holds();
    };
    EXPECT_TRUE(agrees(curves));
    Surface turned = curves;
    std::swap(turned.segments[0][0], turned.segments[0][1]);
    EXPECT_FALSE(agrees(turned));
    curves.segments.pop_back();
    EXPECT_FALSE(agrees(curves));
}

}  // namespace
}  // namespace isoatlas
