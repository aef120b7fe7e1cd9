// verify_atlas: a store against its own checksums and its own samples. The samples are read once.
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>

#include "analysis/analysis_data.h"
#include "base/phase.h"
#include "base/portable.h"
#include "field/order.h"
#include "isoatlas/environment.h"
#include "verify/level_checks.h"
#include "verify/store_checks.h"
#include "verify/tree_checks.h"

namespace isoatlas {
namespace {

/// Runs work; for an unreadable or inconsistent store the check of that name fails with the message of the error. Returns whether it ran.
bool readable(const std::string& name, std::vector<CheckResult>& results, const std::function<void()>& work) {
    try {
        work();
        return true;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled || error.kind() == ErrorKind::resource) throw;
        results.push_back({name, false, error.what()});
        return false;
    }
}

/// The samples, if all checksums are correct.
std::optional<Volume> checksums_are_right(const Atlas& atlas, const Context& context, std::vector<CheckResult>& results) {
    std::optional<Volume> samples;
    if (readable("checksums_are_right", results, [&] { samples = atlas.check(context); }))
        results.push_back({"checksums_are_right", true, std::to_string(atlas.file_bytes()) + " bytes"});
    return samples;
}

/// Voxels of maxima and their events, of an analysis without zones.
EventOfVoxel events_of_maxima(const Analysis& analysis) {
    std::unordered_map<VoxelId, EventId> events;
    analysis.data().visit([&](const auto& held) {
        for (const auto i : held.arrays.code.ids()) {
            const ElementCode code{held.arrays.code[i]};
            if (code.kind() == CodeKind::vertex && code.h0() == 0)
                events.emplace(VoxelId(code.index()), EventId(held.arrays.tree.event_of_element[i]));
        }
    });
    return [events = std::move(events)](VoxelId voxel) {
        const auto found = events.find(voxel);
        return found == events.end() ? EventId::none() : found->second;
    };
}

/// The comparisons at every isovalue.
class SampleComparison {
public:
    SampleComparison(const Atlas& atlas, const Volume& samples, const AtlasVerifyOptions& options)
        : atlas_(atlas), samples_(samples), options_(options), random_(options.seed) {
        own_.interpolant = atlas.interpolant();
        own_.tunnel_height = atlas.tunnel_height();
    }

    void look_at(LevelChecks& checks, std::size_t i, const Context& context) {
        const double tau = checks.isovalues()[i];
        const Cut at = cut(samples_, tau, {.interpolant = own_.interpolant, .tunnel_height = own_.tunnel_height}, context);
        const Surface expected = extract(samples_, tau, own_, context), stored = atlas_.extract(tau, {}, context);
        if (!are_same(stored, expected)) surfaces_.fail("at " + std::to_string(tau) + ": different surface");
        ++surfaces_seen_;
        triangles_ += static_cast<std::int64_t>(stored.triangles.size());
        const SurfaceParts parts(expected);
        for (const std::int64_t object : objects_of(at)) {
            const SurfaceOptions alone{.objects = {object}, .contours = {}};
            if (!are_same(atlas_.extract(tau, alone, context), parts.of(object)))
                objects_.fail("at " + std::to_string(tau) + ": object " + std::to_string(object) + " has a different surface");
            ++objects_seen_;
        }
        checks.look_at(i, at, stored);
    }

    void add_results(std::vector<CheckResult>& results) const {
        const std::string seen = " at " + std::to_string(surfaces_seen_) + " isovalues";
        results.push_back(surfaces_.result(std::to_string(triangles_) + " triangles" + seen));
        results.push_back(objects_.result(std::to_string(objects_seen_) + " objects" + seen));
    }

private:
    /// All of them, or some drawn without repeating.
    std::vector<std::int64_t> objects_of(const Cut& at) {
        std::vector<std::int64_t> ids;
        for (const CutObject& object : at.objects) ids.push_back(object.id);
        const auto wanted = static_cast<std::size_t>(std::max(options_.objects, 0));
        if (options_.full || ids.size() <= wanted) return ids;
        for (std::size_t i = 0; i < wanted; ++i)
            std::swap(ids[i], ids[i + static_cast<std::size_t>(random_.unit() * static_cast<double>(ids.size() - i))]);
        ids.resize(wanted);
        return ids;
    }

    const Atlas& atlas_;
    const Volume& samples_;
    const AtlasVerifyOptions& options_;
    Random random_;
    ExtractOptions own_;
    Check surfaces_{"store_equals_volume"}, objects_{"objects_equal_volume"};
    std::int64_t surfaces_seen_ = 0, objects_seen_ = 0, triangles_ = 0;
};

void compare_at_isovalues(const Atlas& atlas, const Volume& samples, const Analysis& stored, const AtlasVerifyOptions& options,
                          const Context& context, std::vector<CheckResult>& results) {
    LevelChecks checks(stored, random_isovalues(samples, options.levels, options.seed), events_of_maxima(stored));
    SampleComparison comparison(atlas, samples, options);
    Context silent = context;  // nested progress would move the bar back and forth
    silent.progress = nullptr;
    const std::size_t count = checks.isovalues().size();
    for (std::size_t i = 0; i < count; ++i) {
        report(context, only_phase("compare"), static_cast<double>(i) / static_cast<double>(count));
        comparison.look_at(checks, i, silent);
    }
    comparison.add_results(results);
    checks.add_results(results);
}

}  // namespace

std::vector<CheckResult> verify_atlas(const Atlas& atlas, const AtlasVerifyOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    std::vector<CheckResult> results;
    const std::optional<Volume> samples = checksums_are_right(atlas, context, results);
    if (!samples) return results;
    (void)readable("bricks_hold_active_cells", results, [&] { results.push_back(bricks_hold_active_cells(atlas, *samples)); });
    (void)readable("trees_are_readable", results, [&] {
        const Analysis stored = atlas.analysis();
        for (const CheckResult& check :
             {join_tree_is_valid(stored), euler_sums_hold(stored), contour_tree_is_a_tree(stored), levels_match_events(stored)})
            results.push_back(check);
        results.push_back(stored_events_follow_from_elements(atlas, stored));
        (void)readable("stored_tables_are_recomputed", results,
                       [&] { results.push_back(stored_tables_are_recomputed(atlas, *samples, options.full, context)); });
        if (options.full) {
            const Analysis fresh = analyse(*samples, {.interpolant = atlas.interpolant(), .tunnel_height = atlas.tunnel_height()}, context);
            results.push_back(zones_partition_voxels(fresh, *samples));
            results.push_back(stored_tree_equals_analysis(stored, fresh, saddle_tolerance(atlas)));
        }
        (void)readable("queries_are_answered", results, [&] { compare_at_isovalues(atlas, *samples, stored, options, context, results); });
    });
    return results;
}

}  // namespace isoatlas
