// verify_volume: checks the consistency of the analysis, then compares tree, cut and surface at some isovalues.
#include <string>

#include "base/phase.h"
#include "isoatlas/environment.h"
#include "verify/level_checks.h"
#include "verify/tree_checks.h"

namespace isoatlas {

std::vector<CheckResult> verify_volume(const Volume& volume, const VerifyOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    const Analysis analysis = analyse(volume, {.interpolant = options.interpolant, .tunnel_height = options.tunnel_height}, context);
    std::vector<CheckResult> results{join_tree_is_valid(analysis), zones_partition_voxels(analysis, volume), euler_sums_hold(analysis),
                                     contour_tree_is_a_tree(analysis), levels_match_events(analysis)};

    LevelChecks checks(analysis, isovalues_to_check(volume, options.levels), [&](VoxelId voxel) { return analysis.zone(voxel); });
    const ExtractOptions own{.interpolant = options.interpolant,
                             .tunnel_height = options.tunnel_height,
                             .surface = {.objects = {}, .contours = {}, .normals = false}};
    Context silent = context;  // nested progress would move the bar back and forth
    silent.progress = nullptr;
    for (std::size_t i = 0; i < checks.isovalues().size(); ++i) {
        const double tau = checks.isovalues()[i];
        report(context, only_phase("compare"), static_cast<double>(i) / static_cast<double>(checks.isovalues().size()));
        checks.look_at(i, cut(volume, tau, {.interpolant = own.interpolant, .tunnel_height = own.tunnel_height}, silent),
                       extract(volume, tau, own, silent));
    }
    checks.add_results(results);
    return results;
}

}  // namespace isoatlas
