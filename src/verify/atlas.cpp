// verify_atlas: a store against its own checksums, its volume, and what the volume gives.
#include <string>

#include "verify/slice_checks.h"

namespace isoatlas {
namespace {

CheckResult checksums_are_right(const Atlas& atlas, const Context& context) {
    try {
        atlas.check(context);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        return {"checksums_are_right", false, error.what()};
    }
    return {"checksums_are_right", true, std::to_string(atlas.file_bytes()) + " bytes"};
}

bool same(const Surface& p, const Surface& q) {
    return p.points == q.points && p.normals == q.normals && p.triangles == q.triangles && p.segments == q.segments &&
           p.object == q.object && p.contour == q.contour;
}

CheckResult store_equals_volume(const Atlas& atlas, const Volume& volume, const VerifyOptions& options, const Context& context) {
    Check check("store_equals_volume");
    ExtractOptions own;
    own.interpolant = atlas.interpolant();
    own.tunnel_height = atlas.tunnel_height();
    std::int64_t triangles = 0;
    const std::vector<double> isovalues = isovalues_to_check(volume, options.levels);
    for (const double tau : isovalues) {
        const Surface stored = atlas.extract(tau, own, context);
        triangles += static_cast<std::int64_t>(stored.triangles.size());
        if (!same(stored, extract(volume, tau, own, context))) check.fail("at " + std::to_string(tau) + ": another surface");
    }
    return check.result(std::to_string(triangles) + " triangles at " + std::to_string(isovalues.size()) + " isovalues");
}

}  // namespace

std::vector<CheckResult> verify_atlas(const Atlas& atlas, const VerifyOptions& options, const Context& context) {
    std::vector<CheckResult> results{checksums_are_right(atlas, context)};
    if (!results.front().holds) return results;
    const Volume volume = atlas.volume(context);
    Context silent = context;  // its parts would run the bar back and forth
    silent.progress = nullptr;
    results.push_back(store_equals_volume(atlas, volume, options, silent));
    VerifyOptions own = options;
    own.interpolant = atlas.interpolant();
    own.tunnel_height = atlas.tunnel_height();
    for (CheckResult& check : verify_volume(volume, own, context)) results.push_back(std::move(check));
    return results;
}

}  // namespace isoatlas
