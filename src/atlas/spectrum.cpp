#include "isoatlas/spectrum.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>

#include "atlas/access.h"
#include "atlas/object_arrays.h"
#include "atlas/surface_size.h"
#include "atlas/tree_arrays.h"
#include "base/cancel.h"
#include "base/parallel.h"
#include "base/phase.h"
#include "census/count_intervals.h"
#include "isoatlas/active.h"
#include "isoatlas/environment.h"
#include "isoatlas/navigator.h"
#include "isoatlas/objects.h"
#include "mesh/extract_level.h"

namespace isoatlas {
namespace {

/// Id of the object of a branch at an isovalue.
std::int64_t object_at(const Analysis& analysis, const ActiveIndex& index, const RecommendedIsovalue& isovalue) {
    Event event = analysis.event(EventId(isovalue.branch_top));
    while (event.zone.tau_low >= isovalue.tau) event = analysis.event(event.parent);
    const std::vector<ActiveObject> objects = index.at(isovalue.tau, {.contours = false}).objects;
    return std::ranges::find(objects, event.id, &ActiveObject::event)->id;
}

std::vector<SpectrumAdvice> advice_of(const Analysis& analysis, const ObjectTable& table) {
    std::vector<SpectrumAdvice> advice;
    std::optional<ActiveIndex> index;
    for (auto entry = table.entries.begin(); entry != table.entries.end(); ++entry) {
        const std::optional<RecommendedIsovalue> own = isovalue_of(table, *entry);
        advice.push_back({entry->best_tau, entry->id, own ? std::optional(own->reason) : std::nullopt, -1, entry->note});
        if (std::next(entry) != table.entries.end() && std::next(entry)->branch_top == entry->branch_top) continue;  // more lines
        for (const RecommendedIsovalue& other : isovalues_of(table.isovalues, entry->branch_top.number())) {
            const bool has_line = std::ranges::any_of(table.entries, [&](const ObjectEntry& line) {
                return line.branch_top == EventId(other.branch_top) && line.best_tau == other.tau;
            });
            if (has_line) continue;
            if (!index) index.emplace(analysis);
            advice.push_back({other.tau, object_at(analysis, *index, other), other.reason, other.cavity, ""});
        }
    }
    return advice;
}

Spectrum count(const Analysis& analysis, const ObjectTable& table) {
    Spectrum spectrum;
    spectrum.interpolant = analysis.interpolant();
    spectrum.tunnel_height = analysis.tunnel_height();
    spectrum.intervals = count_intervals(analysis, table);
    spectrum.advice = advice_of(analysis, table);
    return spectrum;
}

RankOptions ranking(const SpectrumOptions& options) { return {.top = 0, .selection = options.selection}; }

/// Middles of equal parts of the range, descending.
std::vector<double> isovalues(double low, double high, std::int64_t count) {
    std::vector<double> taus;
    for (std::int64_t i = count; i-- > 0;) {
        const double tau = low + (high - low) * ((static_cast<double>(i) + 0.5) / static_cast<double>(count));
        if (taus.empty() || tau != taus.back()) taus.push_back(tau);
    }
    return taus;
}

std::int64_t count_high(const HighBits& high, const Context& context) {
    const Extent& extent = high.extent();
    std::vector<std::int64_t> of_slice(static_cast<std::size_t>(extent.size[2]), 0);
    for_each_block(context.threads, extent.size[2], [&](std::int64_t z) {
        for (std::int64_t y = 0; y < extent.size[1]; ++y) {
            const std::uint64_t* row = high.row(y, z);
            for (std::int64_t w = 0; w < high.words(); ++w) of_slice[static_cast<std::size_t>(z)] += std::popcount(row[w]);
        }
    });
    return std::accumulate(of_slice.begin(), of_slice.end(), std::int64_t{0});
}

SpectrumSize size_at(const Surface& surface, const Bounds& voxels, std::int64_t cells, const Context& context) {
    const SurfaceSize size = size_of_surface(surface, context);
    const auto facets = static_cast<std::int64_t>(surface.triangles.size() + surface.segments.size());
    return {surface.tau, voxels, cells, facets, size.area, size.measure};
}

/// Context for one isovalue: progress is that of all isovalues.
Context quiet(const Context& context) {
    Context part = context;
    part.progress = nullptr;
    return part;
}

SurfaceOptions bare() { return {.objects = {}, .contours = {}, .normals = false, .ids = false}; }

/// The counts come first.
constexpr PhasePlan<2> kSpectrumPhases{{"counts", "surfaces"}};

/// measure(tau): SpectrumSize.
template <class Measure>
std::vector<SpectrumSize> measure_all(const std::vector<double>& taus, const Context& context, const Measure& measure) {
    std::vector<SpectrumSize> sizes;
    for (const double tau : taus) {
        stop_if_cancelled(context);
        report(context, kSpectrumPhases["surfaces"], static_cast<double>(sizes.size()) / static_cast<double>(taus.size()));
        sizes.push_back(measure(tau));
    }
    return sizes;
}

}  // namespace

Spectrum spectrum(const Volume& volume, const Analysis& analysis, const SpectrumOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    Spectrum spectrum = count(analysis, rank_objects(volume, analysis, ranking(options), context));
    spectrum.selected = options.selection.has_value();
    const auto [low, high] = visit_samples(volume, [](auto samples) {
        const auto [min, max] = std::ranges::minmax(samples);
        return std::pair(static_cast<double>(min), static_cast<double>(max));
    });
    const std::vector<double> taus = isovalues(low, high, options.samples);
    const ExtractOptions how{.interpolant = analysis.interpolant(), .tunnel_height = analysis.tunnel_height(), .surface = bare()};
    Surface surface;
    spectrum.sizes = measure_all(taus, context, [&](double tau) {
        std::int64_t cells = 0;
        const HighBits bits = classify(volume, tau, quiet(context));
        extract_level({volume, tau, bits}, how, quiet(context), surface, &cells);
        const std::int64_t voxels = count_high(bits, context);
        return size_at(surface, {voxels, voxels}, cells, context);
    });
    return spectrum;
}

Spectrum spectrum(const Atlas& atlas, const SpectrumOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    ObjectTable table = atlas.objects(ranking(options), context);
    if (!knows_branches(table)) {
        const Volume volume = atlas.volume(context);
        table = rank_objects(volume, zoned_analysis_of(AtlasAccess::store(atlas), volume, context), ranking(options), context);
    }
    Spectrum spectrum = count(AtlasAccess::analysis(atlas), table);
    spectrum.selected = options.selection.has_value();
    const auto [low, high] = atlas.range();
    Navigator navigator(atlas, bare());
    spectrum.sizes = measure_all(isovalues(low, high, options.samples), context, [&](double tau) {
        const Surface& surface = navigator.go_to(tau, quiet(context));
        return size_at(surface, atlas.preview(tau).voxels, navigator.cost().cells_active, context);
    });
    return spectrum;
}

}  // namespace isoatlas
