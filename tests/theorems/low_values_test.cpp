// Objects of low values (docs/theory/9-low-values.md) against brute force that negates nothing: the low components of the volume behind a
// border of high values, flooded at every isovalue. From trees, cuts, surfaces and tables, of volumes and of stores.
#include "isoatlas/polarity.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "isoatlas/active.h"
#include "isoatlas/both_polarities.h"
#include "isoatlas/cards.h"
#include "isoatlas/isovalue.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::ObjectEntry;
using isoatlas::Polarity;
using isoatlas::ValueType;
using isoatlas::Volume;

/// The grid with one more sample on every side, all of them above every other one.
Grid walled(const Grid& grid) {
    const double wall = *std::max_element(grid.value.begin(), grid.value.end()) + 4;  // isovalues end 1 above the volume
    Grid result{grid.rank, grid.size, {}};
    for (int axis = 0; axis < grid.rank; ++axis) result.size[axis] += 2;
    result.value.assign(static_cast<std::size_t>(result.voxels()), wall);
    for (Index v = 0; v < grid.voxels(); ++v) {
        const std::array<Index, 3> p = grid.voxel(v);
        result.value[result.index(p[0] + 1, p[1] + 1, p[2] + (grid.rank == 3))] = grid.value[v];
    }
    return result;
}

/// The objects {f <= tau} behind that border: per voxel of the grid the number of its object from 1 on; 0: none.
std::vector<Index> flooded(const Grid& grid, const Elements& behind_wall, double tau) {
    const double just_above = std::nextafter(tau, kInfinity);  // low is f < just_above
    const Snapshot at = snapshot(behind_wall, behind_wall.cut_at(just_above));
    std::vector<Index> label;
    for (Index v = 0; v < grid.voxels(); ++v) {
        const std::array<Index, 3> p = grid.voxel(v);
        const Index low = at.low_of[behind_wall.grid.index(p[0] + 1, p[1] + 1, p[2] + (grid.rank == 3))];
        label.push_back(std::max<Index>(low, 0));
    }
    return label;
}

/// Labels by first occurrence: equal texts mean equal partitions.
template <class Labels>
std::vector<Index> partition(const Labels& labels, Index none) {
    std::map<Index, Index> number;
    std::vector<Index> result;
    for (const auto label : labels) {
        const auto of = static_cast<Index>(label);
        result.push_back(of == none ? -1 : number.emplace(of, static_cast<Index>(number.size())).first->second);
    }
    return result;
}

/// The isovalues of low elements, as reported, and values between and beyond them.
std::vector<double> reported_values(const Volume& low, isoatlas::Interpolant interpolant) {
    std::vector<double> taus;
    for (const double stored : interesting_values(elements_of(to_grid(low), interpolant)))
        taus.push_back(low.info.calibration.reported(stored));
    return taus;
}

void are_flooded_behind_a_high_border() {
    const Grid grid = *arbitrary_grid(5, 60);
    const isoatlas::CutOptions options{.interpolant = *arbitrary_interpolant(), .label = true};
    const Elements behind_wall = elements_of(walled(grid), options.interpolant);
    const Volume volume = to_volume(grid, arbitrary_type(grid)), low = isoatlas::negated(volume);
    const isoatlas::Analysis analysis = isoatlas::analyse(low, {.interpolant = options.interpolant}, arbitrary_context());
    const isoatlas::ActiveIndex index(analysis);
    const std::vector<double> taus = reported_values(low, options.interpolant);
    for (int i = 0; i < 4; ++i) {
        const double tau = taus[*rc::gen::inRange<std::size_t>(0, taus.size())];
        const double stored = low.info.calibration.stored(tau);
        const isoatlas::Cut cut = isoatlas::cut(low, stored, options, arbitrary_context());
        const std::vector<Index> expected = flooded(grid, behind_wall, tau);
        RC_ASSERT(partition(cut.label, -1) == partition(expected, 0));
        RC_ASSERT(index.at(stored).objects.size() == cut.objects.size());
        for (std::size_t o = 0; o < cut.objects.size(); ++o) {  // named by a voxel of the lowest value
            double lowest = kInfinity;
            for (Index v = 0; v < grid.voxels(); ++v) {
                if (cut.label[v] == static_cast<std::int32_t>(o)) lowest = std::min(lowest, grid.value[v]);
            }
            RC_ASSERT(volume.value(cut.objects[o].id) == lowest);
        }
        const isoatlas::Surface surface =
            isoatlas::extract(low, stored, {.interpolant = options.interpolant, .surface = {.objects = {}, .contours = {}}});
        RC_ASSERT(std::set<Index>(surface.object.begin(), surface.object.end()).size() == cut.objects.size());
        RC_ASSERT(surface.polarity == Polarity::low);
        RC_ASSERT(surface.reported_tau <= tau);
    }
}
RC_GTEST_PROP(LowObjects, AreFloodedBehindAHighBorder, ()) { are_flooded_behind_a_high_border(); }

// What does not reach the border is a cavity of the objects of high values, wherever no element has the isovalue.
void that_are_enclosed_are_cavities() {
    const Grid grid = *arbitrary_grid(6, 100);
    const isoatlas::CutOptions options{.interpolant = *arbitrary_interpolant(), .label = true};
    const Volume volume = to_volume(grid, arbitrary_type(grid)), low = isoatlas::negated(volume);
    const std::vector<double> values = interesting_values(elements_of(grid, options.interpolant));
    const double tau = values[2 * *rc::gen::inRange<std::size_t>(0, (values.size() + 1) / 2)];  // between two values
    const double stored = low.info.calibration.stored(tau);
    RC_PRE(low.info.calibration.reported(stored) == tau);
    const isoatlas::Cut inside = isoatlas::cut(low, stored, options), outside = isoatlas::cut(volume, tau, options);
    std::set<Index> cavities, enclosed;
    for (const isoatlas::CutContour& contour : outside.contours) {
        if (contour.shell == isoatlas::Shell::inner) cavities.insert(inside.label[contour.id]);
    }
    for (std::size_t o = 0; o < inside.objects.size(); ++o) {
        const isoatlas::CutObject& object = inside.objects[o];
        bool touches = false;
        for (int a = 0; a < grid.rank; ++a) touches = touches || object.box_low[a] == 0 || object.box_high[a] == grid.size[a] - 1;
        if (!touches && (grid.rank == 2 || grid.size[2] > 1)) enclosed.insert(static_cast<Index>(o));
    }
    RC_ASSERT(cavities == enclosed);
}
RC_GTEST_PROP(LowObjects, ThatAreEnclosedAreCavities, ()) { that_are_enclosed_are_cavities(); }

// Trees, levels, zones of the negated volume are those of brute force on the negated samples, in the type's own arithmetic.
void have_the_trees_of_brute_force() {
    const Grid grid = *arbitrary_grid(5, 48);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume low = isoatlas::negated(to_volume(grid, arbitrary_type(grid)));
    const std::string difference = compare(oracle::analyse(elements_of(to_grid(low), interpolant)),
                                           isoatlas::analyse(low, {.interpolant = interpolant}, arbitrary_context()));
    RC_ASSERT(difference == "");
}
RC_GTEST_PROP(LowObjects, HaveTheTreesOfBruteForce, ()) { have_the_trees_of_brute_force(); }

void reach_the_border_where_they_do() {
    const Grid grid = *arbitrary_grid(6, 120);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume low = isoatlas::negated(to_volume(grid, arbitrary_type(grid)));
    const isoatlas::Analysis analysis = isoatlas::analyse(low, {.interpolant = interpolant});
    for (const isoatlas::ObjectEntry& entry : isoatlas::rank_objects(low, analysis, {.top = 0, .gate = false}).entries) {
        const isoatlas::Cut cut = isoatlas::cut(low, entry.best_tau, {.interpolant = interpolant, .label = true});
        unsigned sides = 0;
        Index all = 0, own = 0;
        for (Index v = 0; v < grid.voxels(); ++v) {
            unsigned at = 0;
            for (int a = 0; a < grid.rank; ++a) {
                if (grid.voxel(v)[a] == 0) at |= 1U << (2 * a);
                if (grid.voxel(v)[a] == grid.size[a] - 1) at |= 2U << (2 * a);
            }
            all += at != 0;
            if (at != 0 && cut.label[v] == cut.label[entry.id]) ++own, sides |= at;
        }
        RC_ASSERT(static_cast<unsigned>(entry.border.sides) == sides);
        RC_ASSERT(entry.border.part == static_cast<double>(own) / static_cast<double>(all));
    }
}
RC_GTEST_PROP(LowObjects, ReachTheBorderWhereTheyDo, ()) { reach_the_border_where_they_do(); }

void of_both_polarities_are_one_list() {
    const Grid grid = *arbitrary_grid(6, 120);
    const Volume volume = to_volume(grid, arbitrary_type(grid)), low = isoatlas::negated(volume);
    const isoatlas::ObjectsAndCavities high_tables = isoatlas::rank_both(volume, isoatlas::analyse(volume), {.top = 0, .gate = false});
    const isoatlas::ObjectTable low_table = isoatlas::rank_objects(low, isoatlas::analyse(low), {.top = 0, .gate = false});
    const auto holds = [&](const isoatlas::ObjectEntry& o, Index voxel) {
        const isoatlas::Cut cut = isoatlas::cut(low, o.best_tau, {.label = true});
        return cut.label[voxel] == cut.label[o.id];
    };
    const std::vector<isoatlas::RankedObject> list =
        isoatlas::rank_together(high_tables, low_table, volume.info.extent, {.top = 0, .holds = holds});
    RC_ASSERT(list.size() == high_tables.objects.entries.size() + low_table.entries.size());
    const auto table = [&](Polarity side) -> const isoatlas::ObjectTable& {
        return side == Polarity::high ? high_tables.objects : low_table;
    };
    std::map<std::pair<Polarity, std::size_t>, double> of_card;  // the largest hypervolume of its lines
    std::map<Polarity, std::vector<isoatlas::Card>> cards;
    for (const Polarity side : {Polarity::high, Polarity::low}) {
        cards[side] = cards_of(table(side), volume.info.extent);
        const std::vector<double> hypervolumes = hypervolumes_of_lines(table(side));
        for (std::size_t i = 0; i < hypervolumes.size(); ++i) {
            double& largest = of_card[{side, cards[side][i].line}];
            largest = std::max(largest, hypervolumes[i]);
        }
    }
    std::set<std::pair<Polarity, std::size_t>> seen, seen_cards;
    double before = kInfinity;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::pair<Polarity, std::size_t> card{list[i].polarity, cards[list[i].polarity][list[i].entry].line};
        RC_ASSERT(seen.emplace(list[i].polarity, list[i].entry).second);
        const bool is_new = seen_cards.insert(card).second;
        if (!is_new) RC_ASSERT(list[i].polarity == list[i - 1].polarity && list[i].entry > list[i - 1].entry);  // cards stay together
        if (!is_new) RC_ASSERT((card == std::pair(card.first, cards[card.first][list[i - 1].entry].line)));
        if (list[i].inside >= 0) RC_ASSERT(list[static_cast<std::size_t>(list[i].inside)].polarity == list[i].polarity);
        if (list[i].cavity_of >= 0) RC_ASSERT(list[i].is_enclosed);
        if (list[i].cavity_of >= 0) RC_ASSERT(list[static_cast<std::size_t>(list[i].cavity_of)].polarity == Polarity::high);
        const isoatlas::ObjectTable& own = list[i].polarity == Polarity::high ? high_tables.objects : low_table;
        if (is_background(own, list[i].entry, volume.info.extent)) {
            before = -1;
            continue;
        }
        RC_ASSERT(before >= 0);  // background is last
        RC_ASSERT(of_card[card] <= before);
        before = of_card[card];
    }
    RC_ASSERT(isoatlas::rank_together(high_tables, low_table, volume.info.extent, {.top = 3}).size() ==
              std::min<std::size_t>(3, list.size()));
}
RC_GTEST_PROP(LowObjects, OfBothPolaritiesAreOneList, ()) { of_both_polarities_are_one_list(); }

ObjectEntry line(double tau, std::int64_t voxels, bool is_main, double hypervolume) {
    ObjectEntry entry{};
    entry.best_tau = tau, entry.voxels = voxels, entry.main_branch = is_main, entry.hypervolume = hypervolume;
    entry.appears = is_main ? 20 : 15, entry.branch_top = isoatlas::EventId(is_main ? 0 : 1);
    return entry;
}

/// The main branch from the outside in: 100, 40 and 10 voxels at 5, 10 and 16, of which the last appears at 20.
TEST(LowObjects, AndHighOnesAreRankedByWhatALineShows) {
    isoatlas::ObjectsAndCavities high;
    high.objects.entries = {line(5, 100, true, 9999), line(10, 40, true, 9999), line(16, 10, true, 9999), line(12, 30, false, 171)};
    EXPECT_EQ(hypervolumes_of_lines(high.objects), (std::vector<double>{20 + 150 + 350, 20 + 150, 20, 171}));
    isoatlas::ObjectTable low;
    low.entries = {line(-8, 50, true, 9999)};  // of negated samples: it appears at -3
    low.entries[0].appears = -3;
    EXPECT_EQ(hypervolumes_of_lines(low), (std::vector<double>{125}));
    std::vector<std::pair<Polarity, std::size_t>> list;
    for (const isoatlas::RankedObject& object : isoatlas::rank_together(high, low, {3, {100, 10, 1}}))
        list.emplace_back(object.polarity, object.entry);
    EXPECT_EQ(list, (std::vector<std::pair<Polarity, std::size_t>>{
                        {Polarity::high, 0}, {Polarity::high, 3}, {Polarity::high, 1}, {Polarity::low, 0}, {Polarity::high, 2}}));
}

TEST(LowObjects, AroundEverythingAreBackground) {
    const isoatlas::Extent extent{3, {10, 10, 10}};
    isoatlas::ObjectTable table{.entries = {line(5, 300, true, 0)}};
    for (const auto& [sides, part, expected] : {std::tuple{63, 0.51, true}, {63, 0.5, false}, {60, 0.9, false}, {0, 0.0, false}}) {
        table.entries[0].border = {static_cast<std::uint8_t>(sides), part};
        EXPECT_EQ(is_background(table, 0, extent), expected) << sides << " " << part;
    }
}

/// 488 samples lie at the border. A cube of 125 voxels has 75 samples on three faces: 15.4 %. Sides: all but one, one of every axis, none
/// of the second axis, all.
TEST(LowObjects, AlongTheBorderAreBackground) {
    const isoatlas::Extent extent{3, {10, 10, 10}};
    isoatlas::ObjectTable table{.entries = {line(5, 125, false, 0)}};
    const std::vector<std::tuple<int, double, std::int64_t, bool>> cases{
        {62, 0.155, 125, true},  {62, 0.153, 125, false}, {21, 0.155, 125, true}, {51, 0.9, 125, false},
        {63, 0.155, 125, false}, {62, 0.029, 1, false},   {62, 0.031, 8, true}};
    for (const auto& [sides, part, voxels, expected] : cases) {
        table.entries[0].border = {static_cast<std::uint8_t>(sides), part}, table.entries[0].voxels = voxels;
        EXPECT_EQ(is_background(table, 0, extent), expected) << sides << " " << part << " " << voxels;
    }
    const isoatlas::Extent flat{2, {10, 10, 1}};  // 36 samples; a square of 16 voxels has 8 on two edges: 22.2 %
    for (const auto& [part, expected] : {std::tuple{0.223, true}, {0.22, false}}) {
        table.entries[0].border = {5, part}, table.entries[0].voxels = 16;
        EXPECT_EQ(is_background(table, 0, flat), expected) << part;
    }
}

/// An outline of 500 voxels, with 300 of them in lines inside it; a line inside one of these does not count.
TEST(LowObjects, ThatOtherLinesShowAreBackground) {
    const isoatlas::Extent extent{3, {10, 10, 10}};
    isoatlas::ObjectTable table{.entries = {line(9, 500, true, 0), line(5, 200, true, 0), line(5, 100, false, 0), line(2, 90, false, 0)}};
    for (ObjectEntry& entry : table.entries) entry.inside = 0, entry.border = {1, 0.01};
    table.entries[0].inside = -1, table.entries[3].inside = 1, table.entries[0].outline = true;
    EXPECT_TRUE(is_background(table, 0, extent));
    table.entries[2].voxels = 99;
    EXPECT_FALSE(is_background(table, 0, extent));
    table.entries[2].voxels = 100, table.entries[0].outline = false;
    EXPECT_FALSE(is_background(table, 0, extent));
    table.entries[0].outline = true, table.entries[0].border = {};  // of high values
    EXPECT_FALSE(is_background(table, 0, extent));
    for (std::size_t i = 1; i < table.entries.size(); ++i) EXPECT_FALSE(is_background(table, i, extent)) << i;
}

// Numbers.

double arbitrary_double() {
    const auto mantissa = static_cast<double>(*rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << 53), std::int64_t{1} << 53));
    return std::ldexp(mantissa, *rc::gen::inRange(-70, -19));
}

RC_GTEST_PROP(LowValues, ReadBackAsTheLeastThatNamesThem, ()) {
    const double mirror = *rc::gen::element(0.0, 255.0, -1.0, 65535.0, 4294967295.0);
    const double stored = arbitrary_double(), reported = isoatlas::mirrored(mirror, stored);
    RC_ASSERT(isoatlas::mirrored(mirror, reported) <= stored);
    RC_ASSERT(isoatlas::mirrored(mirror, std::nextafter(reported, -kInfinity)) > stored);
    const double other = arbitrary_double();
    RC_ASSERT((isoatlas::mirrored(mirror, stored) <= other) == (isoatlas::mirrored(mirror, other) <= stored));
    if (mirror == 0) RC_ASSERT(reported == -stored);
}

TEST(LowValues, OfSamplesAreExactForEveryType) {
    for (const ValueType type :
         {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::i16, ValueType::u32, ValueType::i32, ValueType::f32, ValueType::f64}) {
        isoatlas::visit_type(type, []<class T>(T) {
            using Limits = std::numeric_limits<T>;
            const std::vector<T> samples{Limits::lowest(), Limits::max(),       T{0}, T{1}, T{77}, static_cast<T>(Limits::max() / 3),
                                         Limits::min(),    Limits::denorm_min()};
            const Volume volume = isoatlas::make_volume<T>({3, {2, 2, 2}}, samples);
            const Volume low = isoatlas::negated(volume), back = isoatlas::negated(low);
            EXPECT_EQ(polarity_of(volume.info), Polarity::high);
            EXPECT_EQ(polarity_of(low.info), Polarity::low);
            EXPECT_EQ(low.info.type, volume.info.type);
            for (Index v = 0; v < 8; ++v) {
                EXPECT_EQ(low.reported(v), volume.value(v));
                EXPECT_EQ(isoatlas::stored_isovalue(low.info, volume.value(v)), low.value(v));
                for (Index w = 0; w < 8; ++w) EXPECT_EQ(volume.value(v) < volume.value(w), low.value(v) > low.value(w));
            }
            EXPECT_EQ(back.bytes, volume.bytes);
            EXPECT_EQ(back.info.calibration, volume.info.calibration);
        });
    }
}

TEST(LowValues, KeepTheBitsOfZeros) {
    const Volume volume = isoatlas::make_volume<float>({3, {2, 1, 1}}, std::vector<float>{0.0F, -0.0F});
    EXPECT_EQ(isoatlas::negated(isoatlas::negated(volume)).bytes, volume.bytes);
}

TEST(LowValues, AreCalibratedAsTheFileIs) {
    Volume volume = isoatlas::make_volume<std::int16_t>({3, {2, 1, 1}}, std::vector<std::int16_t>{-1000, 400});
    volume.info.calibration = {.slope = 0.1, .intercept = -3};
    const Volume low = isoatlas::negated(volume);
    for (Index v = 0; v < 2; ++v) {
        EXPECT_EQ(low.reported(v), volume.reported(v));
        EXPECT_EQ(isoatlas::stored_isovalue(low.info, low.reported(v)), low.value(v));
    }
    EXPECT_EQ(low.info.calibration.reported_difference(5), 0.5);
    EXPECT_EQ(low.info.calibration.reported_interval(low.value(1), low.value(0)), (std::array{volume.reported(0), volume.reported(1)}));
    EXPECT_EQ(low.info.calibration.reported(-kInfinity), kInfinity);
}

// A hollow ball that touches no border, a channel that joins two sides, and a corner: of low values in a block of 9^3.
TEST(LowObjects, ChannelsThatReachTheBorderAreObjects) {
    Grid grid{3, {9, 9, 9}, {}};
    for (Index v = 0; v < grid.voxels(); ++v) {
        const auto [x, y, z] = grid.voxel(v);
        const bool channel = y == 2 && z == 2, hole = x >= 4 && x <= 6 && y >= 5 && y <= 7 && z >= 4 && z <= 6, corner = x + y + z >= 23;
        grid.value.push_back(channel ? 10 : hole ? 20 : corner ? 30 : 100);
    }
    const Volume low = isoatlas::negated(to_volume(grid, ValueType::u8));
    const isoatlas::ObjectTable table = isoatlas::rank_objects(low, isoatlas::analyse(low), {.top = 0, .gate = false});
    std::map<double, std::string> sides;  // by the value at which they appear
    for (const isoatlas::ObjectEntry& entry : table.entries) sides[low.info.calibration.reported(entry.appears)] = sides_text(entry.border);
    EXPECT_EQ(sides, (std::map<double, std::string>{{10, "-x +x"}, {20, ""}, {30, "+x +y +z"}}));
    EXPECT_EQ(border_text({.sides = 3, .part = 0.004}, low.info.extent), "reaches the border at -x +x (less than 1 % of it)");
    EXPECT_EQ(border_text({.sides = 63, .part = 0.8}, low.info.extent), "reaches the border on all sides (80 % of it)");
    EXPECT_EQ(border_text({.sides = 0, .part = 0}, low.info.extent), "");
}

}  // namespace
}  // namespace oracle
