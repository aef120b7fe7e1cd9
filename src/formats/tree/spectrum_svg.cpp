// The spectrum as a plot: counts of all objects, counts of significant ones, and sizes, over one axis of isovalues.
#include <algorithm>
#include <array>
#include <cmath>

#include "formats/common/connectivity.h"
#include "formats/common/plot.h"
#include "formats/tree/spectrum_formats.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMarks = 12;

struct Range {
    double low, high;
};

/// Range of the axis: reported isovalues with events or measures.
Range range_of(const VolumeInfo& info, const Spectrum& spectrum) {
    Range range{0, 1};
    bool first = true;
    const auto add = [&](double stored) {
        if (!std::isfinite(stored)) return;
        const double value = info.calibration.reported(stored);
        range = first ? Range{value, value} : Range{std::min(range.low, value), std::max(range.high, value)};
        first = false;
    };
    for (const SpectrumInterval& interval : spectrum.intervals) add(interval.low), add(interval.high);
    for (const SpectrumSize& size : spectrum.sizes) add(size.tau);
    return range;
}

/// number(interval) as steps: constant on every interval.
template <class Number>
PlotCurve count_curve(const std::string& name, const std::string& colour, bool thick, const VolumeInfo& info, const Spectrum& spectrum,
                      const Range& range, const Number& number) {
    PlotCurve curve{name, colour, {}, true, thick};
    const bool is_low = polarity_of(info) == Polarity::low;
    for (const SpectrumInterval& interval : spectrum.intervals) {
        const double low = std::isfinite(interval.low) ? info.calibration.reported(interval.low) : is_low ? range.high : range.low;
        const double high = info.calibration.reported(interval.high);
        curve.points.push_back({std::min(low, high), static_cast<double>(number(interval))});
    }
    if (!spectrum.intervals.empty() && !is_low) curve.points.push_back({info.calibration.reported(spectrum.intervals.front().high), 0});
    std::ranges::stable_sort(curve.points, {}, [](const std::array<double, 2>& point) { return point[0]; });
    return curve;
}

/// Relative to the maximum, so that different units share a plot.
template <class Number>
PlotCurve size_curve(const std::string& name, const std::string& colour, const VolumeInfo& info, const Spectrum& spectrum,
                     const Number& number) {
    double max = 0;
    for (const SpectrumSize& size : spectrum.sizes) max = std::max(max, number(size));
    PlotCurve curve{name + " (most " + short_text(max) + ")", colour, {}, false, true};
    for (const SpectrumSize& size : spectrum.sizes)
        curve.points.push_back({info.calibration.reported(size.tau), max > 0 ? 100 * number(size) / max : 0});
    std::ranges::stable_sort(curve.points, {}, [](const std::array<double, 2>& point) { return point[0]; });
    return curve;
}

/// The object and the reason: "object 7 (stable, inside 1)".
std::string text_of(const SpectrumAdvice& advice) {
    std::string object = "object " + std::to_string(advice.object);
    if (advice.reason == IsovalueReason::inner) object = "the wall of cavity v" + std::to_string(advice.cavity) + " of " + object;
    std::string why = advice.reason ? name_of(*advice.reason) : "";
    if (!advice.note.empty() && advice.note != why) why += (why.empty() ? "" : ", ") + advice.note;
    return why.empty() ? object : object + " (" + why + ")";
}

Plot plot_of(const std::string& title, const VolumeInfo& info, const Spectrum& spectrum, const Range& range) {
    Plot plot;
    plot.title = title;
    plot.x_name = "isovalue" + (info.value_unit.empty() ? "" : " [" + info.value_unit + "]");
    plot.x_low = range.low, plot.x_high = range.high;
    for (std::size_t i = 0; i < std::min(kMarks, spectrum.advice.size()); ++i) {
        const SpectrumAdvice& advice = spectrum.advice[i];
        const double tau = info.calibration.reported(advice.tau);
        plot.marks.push_back({tau, short_text(tau) + " shows " + text_of(advice)});
    }
    return plot;
}

Plot plot_of_counts(const std::string& title, const VolumeInfo& info, const Spectrum& spectrum, const Range& range,
                    LevelCounts SpectrumInterval::* counts) {
    const bool flat = info.extent.rank == 2;
    Plot plot = plot_of(title, info, spectrum, range);
    plot.logarithmic = true;
    const auto add = [&](const char* name, const char* colour, bool thick, std::int64_t LevelCounts::* number) {
        plot.curves.push_back(count_curve(name, colour, thick, info, spectrum, range,
                                          [=](const SpectrumInterval& interval) { return interval.*counts.*number; }));
    };
    add("contours", "#7f7f7f", false, &LevelCounts::contours);
    add(flat ? "holes" : "tunnels", "#d62728", false, &LevelCounts::tunnels);
    if (!flat) add("cavities", "#2ca02c", false, &LevelCounts::cavities);
    add("objects", "#1f77b4", true, &LevelCounts::objects);
    return plot;
}

Plot plot_of_sizes(const VolumeInfo& info, const Spectrum& spectrum, const Range& range) {
    const bool flat = info.extent.rank == 2;
    Plot plot = plot_of("Size of the surface, percent of the maximum", info, spectrum, range);
    const auto add = [&](const char* name, const char* colour, auto&& number) {
        plot.curves.push_back(size_curve(name, colour, info, spectrum, number));
    };
    add(flat ? "length" : "area", "#9467bd", [](const SpectrumSize& size) { return size.area; });
    add(flat ? "area" : "volume", "#8c564b", [](const SpectrumSize& size) { return size.measure; });
    add(flat ? "segments" : "triangles", "#e377c2", [](const SpectrumSize& size) { return static_cast<double>(size.facets); });
    return plot;
}

}  // namespace

void write_spectrum_svg(Sink& sink, const VolumeInfo& info, const Spectrum& spectrum) {
    const Range range = range_of(info, spectrum);
    const std::string some = spectrum.selected ? "the selected objects" : "the significant objects";
    std::vector<Plot> plots{plot_of_counts("Number at each isovalue", info, spectrum, range, &SpectrumInterval::all),
                            plot_of_counts("Of " + some, info, spectrum, range, &SpectrumInterval::significant)};
    if (!spectrum.sizes.empty()) plots.push_back(plot_of_sizes(info, spectrum, range));
    sink.write(svg_of(plots));
}

}  // namespace isoatlas
