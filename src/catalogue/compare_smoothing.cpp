#include "catalogue/compare_smoothing.h"

#include <algorithm>

#include "base/cancel.h"
#include "base/phase.h"
#include "catalogue/at_once.h"
#include "isoatlas/cut.h"
#include "isoatlas/filter.h"
#include "isoatlas/objects.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMostBytes = std::int64_t{1} << 29;  ///< of samples: two volumes are held

ShownSmoothing shown_at(const Volume& volume, const CutOptions& options, double tau, const PageOptions& page, const Context& context) {
    stop_if_cancelled(context);
    const Cut at = cut(volume, tau, options, context);
    ShownSmoothing shown{.objects = std::ssize(at.objects)};
    for (const CutObject& object : at.objects) shown.tunnels += object.b1;
    PageOptions still = page;
    still.frames = 1;
    const Colour colour = colour_of_object(1);
    if (volume.info.extent.rank == 2) {
        shown.picture = draw_still(volume, tau, colour, still, context);
        return shown;
    }
    ExtractOptions extracted{.interpolant = options.interpolant, .tunnel_height = options.tunnel_height};
    extracted.surface.ids = false;
    shown.picture = draw_turntable(extract(volume, tau, extracted, context), colour, still, context);
    return shown;
}

}  // namespace

std::optional<SmoothingComparison> compare_smoothing(const Atlas& atlas, double sigma, const PageOptions& options, const Context& context) {
    const VolumeInfo& info = atlas.info();
    if (info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type)) > kMostBytes) return std::nullopt;
    Context silent = context;
    silent.progress = nullptr;
    const ObjectTable table = atlas.objects({.top = 0}, silent);
    if (table.entries.empty()) return std::nullopt;
    std::size_t first = 0;
    while (first < table.entries.size() && is_background(table, first, info.extent)) ++first;
    SmoothingComparison comparison;
    comparison.tau = table.entries[first < table.entries.size() ? first : 0].best_tau;
    const CutOptions cut_options{.interpolant = atlas.interpolant(), .tunnel_height = atlas.tunnel_height()};
    report(context, only_phase("smooth"), 0);
    const Volume volume = atlas.volume(silent);
    const auto show = [&](const Volume& shown, const Context& own) { return shown_at(shown, cut_options, comparison.tau, options, own); };
    at_once(
        context, [&](const Context& own) { comparison.as_is = show(volume, own); },
        [&](const Context& own) { comparison.smooth = show(gaussian_filter(volume, sigma, own), own); });
    return comparison;
}

}  // namespace isoatlas
