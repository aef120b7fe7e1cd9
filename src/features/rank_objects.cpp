// The table of significant objects: gate, isovalues, sizes (docs/theory/7-which-objects-matter.md).
#include <algorithm>
#include <limits>
#include <optional>

#include "analysis/analysis_data.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "features/border_contact.h"
#include "features/cavity_walls.h"
#include "features/noise.h"
#include "features/rank.h"
#include "features/zone_sums.h"
#include "field/order.h"
#include "isoatlas/environment.h"
#include "isoatlas/objects.h"
#include "isoatlas/polarity.h"

namespace isoatlas {
namespace {

template <class Id>
class Ranking {
public:
    Ranking(const VolumeView& volume, const AnalysisArrays<Id>& arrays, bool is_3d)
        : volume_(volume),
          arrays_(arrays),
          is_3d_(is_3d),
          values_(event_values(arrays)),
          tree_(superlevel_tree<Id>(arrays, values_)),
          zones_(sum_zones(tree_, volume_)),
          branches_(decompose_branches(tree_, zones_)) {}

    [[nodiscard]] CandidateTable candidates(const NoiseModel& noise, const RankOptions& options) const {
        return find_candidates(volume_, tree_, branches_, noise, options);
    }

    [[nodiscard]] ZoneSums take_zones() && { return std::move(zones_); }

    /// chosen: of candidates(). around: as for wall_isovalues().
    [[nodiscard]] ObjectTable table(const NoiseModel& noise, CandidateTable chosen, const CavityCandidates<Id>& cavities,
                                    const std::vector<EventId>& around_cavities) const {
        ObjectTable table;
        table.noise = noise.sigma;
        for (const BranchId i : streamed<BranchId>(branches_.branch.size(), {sizeof(Branch)}))
            table.branches += branches_.branch[i].appears > branches_.branch[i].merges;
        const std::vector<std::int64_t> around = closest_around(tree_, chosen.rows);
        const std::vector<BranchIsovalue> walls = wall_isovalues(volume_, arrays_, tree_, branches_, chosen, cavities, around_cavities);
        chosen.isovalues.insert(chosen.isovalues.end(), walls.begin(), walls.end());
        std::ranges::stable_sort(chosen.isovalues, {}, &BranchIsovalue::branch);
        for (const BranchIsovalue& own : chosen.isovalues)
            table.isovalues.push_back({branches_.branch[own.branch].top.number(), own.tau, own.prominence, own.reason, own.cavity});
        for (std::size_t i = 0; i < chosen.rows.size(); ++i) table.entries.push_back(entry(chosen.rows[i], around[i]));
        if (polarity_of(*volume_.info) == Polarity::low) add_border_contacts(volume_, tree_, table.entries);
        return first_entries(std::move(table), 0);
    }

private:
    [[nodiscard]] ObjectEntry entry(const Candidate& row, std::int64_t inside) const {
        const ElementCode code{arrays_.code[arrays_.tree.top[branches_.highest[row.event]]]};
        ObjectEntry entry{};
        entry.id = code.index();  // the highest element of an object is a maximum: a voxel
        entry.event = row.event;
        entry.appears = row.appears, entry.merges = row.merges, entry.best_tau = row.tau;
        entry.voxels = row.voxels, entry.measure = row.measure, entry.hypervolume = row.hypervolume;
        const auto contours = static_cast<std::int64_t>(arrays_.measures.contours[row.event]);
        entry.cavities = is_3d_ ? contours - 1 : 0;
        entry.tunnels = 1 + entry.cavities - static_cast<std::int64_t>(arrays_.measures.chi[row.event]);
        entry.position = element_position(code, volume_.info->extent);
        entry.tau_low = tree_.is_root(row.event) ? -std::numeric_limits<double>::infinity() : tree_.height[tree_.parent(row.event)];
        entry.tau_high = tree_.height[row.event];
        entry.inside = inside;
        entry.branch_top = branches_.branch[row.branch].top;
        entry.outline = row.outline;
        entry.main_branch = row.branch == kMainBranch;
        return entry;
    }

    const VolumeView volume_;
    const AnalysisArrays<Id>& arrays_;
    bool is_3d_;
    BigVector<double> values_;
    ObjectTree<Id> tree_;
    ZoneSums zones_;
    BranchDecomposition branches_;
};

/// Calls use(arrays, noise, significant cavities, table of objects, sums of the zones of objects).
template <class Use>
auto with_tables(const VolumeView& volume, const Analysis& analysis, const RankOptions& options, const Context& context, const Use& use) {
    if (volume.info->extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
    const NoiseModel noise = fit_noise(volume);
    return analysis.data().visit([&]<class Id>(const IndexedArrays<Id>& held) {
        const AnalysisArrays<Id>& arrays = held.arrays;
        if (arrays.zone.empty()) throw Error(ErrorKind::usage, {.what = "ranking objects needs an analysis with zones"});
        CavityCandidates<Id> cavities;
        std::optional<Ranking<Id>> ranking;
        CandidateTable chosen;
        run_both(
            context.threads, [&] { cavities = make_cavity_candidates(volume, arrays, noise, {.top = 0}, context); },
            [&] {
                ranking.emplace(volume, arrays, analysis.extent().rank == 3);
                chosen = ranking->candidates(noise, options);
            });
        ObjectTable table = ranking->table(noise, std::move(chosen), cavities, objects_around(analysis, arrays, cavities));
        return use(arrays, noise, cavities, std::move(table), std::move(*ranking).take_zones());
    });
}

}  // namespace

ObjectTable rank_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    return with_tables(volume, analysis, options, context,
                       [](const auto&, const NoiseModel&, const auto&, ObjectTable table, const ZoneSums&) { return table; });
}

ObjectTable rank_objects(const Volume& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    return rank_objects(VolumeView(volume), analysis, options, context);
}

ObjectsAndCavities rank_both(const VolumeView& volume, const Analysis& analysis, const RankOptions& options, const Context& context,
                             ZoneSums* sums) {
    return with_tables(volume, analysis, options, context,
                       [&](const auto& arrays, const NoiseModel& noise, const auto& cavities, ObjectTable table, ZoneSums zones) {
                           if (sums != nullptr) *sums = std::move(zones);
                           const bool is_same = options.gate && !options.selection;  // the same cavities as for the table of objects
                           CavityTable cavity_rows = is_same ? cavity_table(volume, analysis, arrays, cavities, noise, options.top)
                                                             : rank_cavities(volume, analysis, options, context);
                           return ObjectsAndCavities{std::move(table), std::move(cavity_rows)};
                       });
}

ObjectsAndCavities rank_both(const Volume& volume, const Analysis& analysis, const RankOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    return rank_both(VolumeView(volume), analysis, options, context);
}

}  // namespace isoatlas
