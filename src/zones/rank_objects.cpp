// The table of essential objects: gate, isovalues, sizes (essential.md sections 0 to 3).
#include <algorithm>
#include <limits>

#include "field/order.h"
#include "isoatlas/objects.h"
#include "zones/analysis_data.h"
#include "zones/branch_rows.h"
#include "zones/noise.h"
#include "zones/rank.h"

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
          tree_(bright_side<Id>(arrays, values_)),
          branches_(make_branches(tree_, sum_zones(tree_, volume_))) {}

    [[nodiscard]] ObjectTable table(const RankOptions& options) const {
        ObjectTable table;
        const NoiseModel noise = fit_noise(volume_);
        table.noise = noise.sigma;
        for (const Branch& b : branches_.branch) table.branches += b.appears > b.merges;
        const auto [rows, isovalues] = branch_rows(volume_, tree_, branches_, noise, options);
        const std::vector<std::int64_t> around = closest_around(tree_, rows);
        for (const BranchIsovalue& own : isovalues)
            table.isovalues.push_back({branches_.branch[own.branch].top, own.tau, own.prominence, own.reason});
        for (std::size_t i = 0; i < rows.size(); ++i) table.entries.push_back(entry(rows[i], around[i]));
        return first_entries(std::move(table), 0);
    }

private:
    [[nodiscard]] ObjectEntry entry(const BranchRow& row, std::int64_t inside) const {
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
        entry.tau_low = tree_.is_root(row.event) ? -std::numeric_limits<double>::infinity() : values_[tree_.parent[row.event]];
        entry.tau_high = values_[row.event];
        entry.inside = inside;
        entry.branch_top = branches_.branch[row.branch].top;
        entry.outline = row.outline;
        entry.trunk = row.branch == 0;
        return entry;
    }

    const VolumeView volume_;
    const AnalysisArrays<Id>& arrays_;
    bool is_3d_;
    BigVector<double> values_;
    SideTree<Id> tree_;
    Branches branches_;
};

}  // namespace

ObjectTable rank_objects(const VolumeView& volume, const Analysis& analysis, const RankOptions& options) {
    if (volume.info->extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
    return analysis.data().visit([&](const auto& held) {
        if (held.arrays.zone.empty()) throw Error(ErrorKind::usage, {.what = "ranking objects needs an analysis with zones"});
        return Ranking(volume, held.arrays, analysis.extent().rank == 3).table(options);
    });
}

ObjectTable rank_objects(const Volume& volume, const Analysis& analysis, const RankOptions& options, const Context&) {
    return rank_objects(VolumeView(volume), analysis, options);
}

}  // namespace isoatlas
