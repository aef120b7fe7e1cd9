// Dark objects are the low components of brute force, at every isovalue and from birth to death.
#include "isoatlas/cavities.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "oracle/difference.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::CavityEntry;
using isoatlas::CavityTable;
using isoatlas::Volume;

/// Cavities by descending voxels, then id, and what each voxel lies in.
struct Cavities {
    std::vector<Index> ids;
    std::vector<std::uint32_t> label;
};

Cavities cavities_at(const Elements& elements, double tau) {
    const Snapshot snapshot = oracle::snapshot(elements, elements.cut_at(tau));
    std::vector<Index> voxels(snapshot.lows.size(), 0);
    for (Index v = 0; v < elements.grid.voxels(); ++v) {
        if (snapshot.low_of[v] > 0) ++voxels[snapshot.low_of[v]];
    }
    std::vector<std::pair<Index, Index>> order;  // -voxels, id
    std::map<Index, Index> low_of_id;
    for (std::size_t low = 1; low < snapshot.lows.size(); ++low) {
        order.push_back({-voxels[low], snapshot.lows[low].lowest});
        low_of_id[snapshot.lows[low].lowest] = static_cast<Index>(low);
    }
    std::sort(order.begin(), order.end());
    Cavities cavities;
    std::map<Index, std::uint32_t> number;
    for (const auto& [size, id] : order) {
        cavities.ids.push_back(id);
        number[low_of_id[id]] = static_cast<std::uint32_t>(cavities.ids.size());
    }
    for (Index v = 0; v < elements.grid.voxels(); ++v) {
        const Index low = snapshot.low_of[v];
        cavities.label.push_back(low > 0 ? number[low] : 0);
    }
    return cavities;
}

void cavities_are_labelled_as_low_components() {
    const Grid grid = *arbitrary_grid(6, 120);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const Elements elements = elements_of(grid, interpolant);
    const std::vector<double> values = interesting_values(elements);
    for (int i = 0; i < 5; ++i) {
        const double tau = values[*rc::gen::inRange<std::size_t>(0, values.size())];
        const Cavities expected = cavities_at(elements, tau);
        std::vector<std::int64_t> ids;
        const std::vector<std::uint32_t> label = isoatlas::label_cavities(volume, analysis, tau, ids, arbitrary_context());
        RC_ASSERT(ids == expected.ids);
        RC_ASSERT(label == expected.label);
    }
}

/// All low components but the outside, from their minimum to the value where they merge with a larger one: the one of largest hypervolume
/// goes on, and the outside always does. Samples must be whole numbers, so that sums are exact.
std::multiset<std::pair<double, double>> lives_of(const Elements& elements) {
    std::multiset<std::pair<double, double>> lives;  // merges, hypervolume
    const std::vector<double> all = interesting_values(elements);
    Snapshot before;
    for (std::size_t i = 2; i < all.size(); i += 2) {  // just above each value
        Snapshot now = snapshot(elements, elements.cut_at(all[i]));
        const double value = all[i - 1];
        std::map<Index, std::vector<Index>> merging;  // by low component now: those before
        for (std::size_t low = 0; low < before.lows.size(); ++low) {
            Index in = 0;
            for (Index e = 0; e < elements.count(); ++e) {
                if (before.low_of[e] == static_cast<Index>(low) && low > 0) in = now.low_of[e];
            }
            merging[in].push_back(static_cast<Index>(low));
        }
        for (const auto& [in, lows] : merging) {
            std::vector<double> hypervolume;
            for (const Index low : lows) {
                double sum = 0, voxels = 0;
                for (Index v = 0; v < elements.grid.voxels(); ++v) {
                    if (before.low_of[v] == low) sum += elements.grid.value[v], ++voxels;
                }
                hypervolume.push_back(low == 0 ? kInfinity : voxels * value - sum);
            }
            hypervolume.erase(std::max_element(hypervolume.begin(), hypervolume.end()));
            for (const double h : hypervolume) lives.insert({value, h});
        }
        before = std::move(now);
    }
    return lives;
}

void cavities_live_as_long_as_brute_force_says() {
    Grid grid = *arbitrary_grid(6, 100);
    for (double& v : grid.value) v = std::floor(v);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const Elements elements = elements_of(grid, interpolant);
    const CavityTable table = isoatlas::rank_cavities(volume, analysis, {.top = 0, .gate = false});
    std::multiset<std::pair<double, double>> lives;
    for (const CavityEntry& entry : table.entries) lives.insert({entry.merges, entry.hypervolume});
    RC_ASSERT(lives == lives_of(elements));
    RC_ASSERT(table.branches == static_cast<Index>(table.entries.size()));
    for (std::size_t i = 1; i < table.entries.size(); ++i) RC_ASSERT(table.entries[i - 1].hypervolume >= table.entries[i].hypervolume);
}

/// The isovalues of an entry are isovalues of its branch, and name what it is there.
void check_isovalues(const CavityTable& table, const CavityEntry& entry, const Elements& elements) {
    const std::vector<isoatlas::RecommendedIsovalue> own = isovalues_of(table.isovalues, entry.branch_minimum);
    RC_ASSERT(!own.empty());
    RC_ASSERT(own[0].tau == entry.best_tau);
    RC_ASSERT(own[0].reason == entry.reason);
    RC_ASSERT(own[0].cavity == entry.id);
    for (const isoatlas::RecommendedIsovalue& isovalue : own) {
        RC_ASSERT(entry.appears < isovalue.tau);
        RC_ASSERT(isovalue.tau <= entry.merges);
        const Snapshot at = snapshot(elements, elements.cut_at(isovalue.tau));
        RC_ASSERT(at.lows[at.low_of[entry.branch_minimum]].lowest == isovalue.cavity);
    }
}

void cavities_are_what_their_best_isovalue_shows() {
    const Grid grid = *arbitrary_grid(6, 100);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const Elements elements = elements_of(grid, interpolant);
    const CavityTable table = isoatlas::rank_cavities(volume, analysis, {.top = 8, .gate = false});
    for (const CavityEntry& entry : table.entries) {
        check_isovalues(table, entry, elements);
        RC_ASSERT(entry.appears < entry.best_tau);
        RC_ASSERT(entry.best_tau <= entry.merges);
        RC_ASSERT(entry.tau_low < entry.best_tau);
        RC_ASSERT(entry.best_tau <= entry.tau_high);
        for (const double tau : {entry.best_tau, std::nextafter(entry.tau_low, kInfinity), entry.tau_high}) {
            if (!std::isfinite(tau)) continue;
            const Snapshot at = snapshot(elements, elements.cut_at(tau));
            const auto low = static_cast<Index>(
                std::find_if(at.lows.begin() + 1, at.lows.end(), [&](const LowComponent& l) { return l.lowest == entry.id; }) -
                at.lows.begin());
            RC_ASSERT(low < static_cast<Index>(at.lows.size()));
            Index voxels = 0, contours = 0;
            for (Index v = 0; v < grid.voxels(); ++v) voxels += at.low_of[v] == low;
            for (const Contour& contour : at.contours) contours += contour.low == low;
            RC_ASSERT(contours == 1 + entry.islands);
            if (tau != entry.best_tau) continue;
            RC_ASSERT(voxels == entry.voxels);
            const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant});
            const auto wall = std::find_if(cut.contours.begin(), cut.contours.end(), [&](const isoatlas::CutContour& c) {
                return c.shell == isoatlas::Shell::inner && c.id == entry.id;
            });
            RC_ASSERT(wall != cut.contours.end());
            RC_ASSERT(wall->object == entry.object);
            RC_ASSERT(wall->genus == entry.tunnels);
            const isoatlas::ExtractOptions options{.interpolant = interpolant, .surface = {.objects = {}, .contours = {entry.id}}};
            RC_ASSERT(!isoatlas::extract(volume, tau, options).points.empty());
        }
    }
}

// A hollow with a darker core is shown at two isovalues: one for the wall of each.
TEST(Cavities, WithTwoBoundariesHaveTwoIsovalues) {
    constexpr Index n = 33;
    std::vector<float> samples;
    for (Index v = 0; v < n * n * n; ++v) {
        const auto x = static_cast<double>(v % n - 16), y = static_cast<double>(v / n % n - 16), z = static_cast<double>(v / (n * n) - 16);
        const double r = std::sqrt(x * x + y * y + z * z);
        const auto rise = [r](double at) { return 1 / (1 + std::exp((at - r) / 0.4)); };
        samples.push_back(static_cast<float>(10 + r / 100 + 40 * rise(5) + 50 * rise(10) - 100 * rise(14)));
    }
    const Volume volume = isoatlas::make_volume<float>({3, {n, n, n}}, samples);
    const CavityTable table = isoatlas::rank_cavities(volume, isoatlas::analyse(volume));
    ASSERT_EQ(table.entries.size(), 1U);
    const std::vector<isoatlas::RecommendedIsovalue> own = isovalues_of(table.isovalues, table.entries[0].branch_minimum);
    const auto has = [&](double low, double high) {
        return std::ranges::any_of(own, [&](const auto& isovalue) { return low < isovalue.tau && isovalue.tau < high; });
    };
    EXPECT_TRUE(has(15, 45));
    EXPECT_TRUE(has(55, 95));
}

RC_GTEST_PROP(Cavities, AreLabelledAsLowComponents, ()) { cavities_are_labelled_as_low_components(); }
RC_GTEST_PROP(Cavities, LiveAsLongAsBruteForceSays, ()) { cavities_live_as_long_as_brute_force_says(); }
RC_GTEST_PROP(Cavities, AreWhatTheirBestIsovalueShows, ()) { cavities_are_what_their_best_isovalue_shows(); }

}  // namespace
}  // namespace oracle
