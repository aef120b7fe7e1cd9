// write_curves: number of objects for every threshold of a size.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/atomic_file.h"
#include "formats/common/byte_writer.h"
#include "formats/common/connectivity.h"
#include "formats/common/file_extension.h"
#include "formats/common/generator.h"
#include "formats/common/plot.h"
#include "formats/tree/simplified_formats.h"
#include "formats/volume/volume_json.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

/// Decades from the smallest positive threshold; 0 is drawn at the left end.
Plot plot_of(const VolumeInfo& info, const SelectionCurve& curve) {
    double low = INFINITY, high = 0;
    for (const double threshold : curve.threshold) {
        const double x = reported_threshold(info, curve, threshold);
        if (x > 0) low = std::min(low, x);
        high = std::max(high, x);
    }
    if (!std::isfinite(low)) low = high = 1;
    const auto place = [&](double threshold) { return std::log10(std::max(reported_threshold(info, curve, threshold), low)); };
    Plot plot;
    plot.title = "Number of objects, by minimum " + curve.size;
    plot.x_name = "log10 of the minimum " + curve.size;
    plot.x_low = std::log10(low), plot.x_high = std::log10(high);
    plot.logarithmic = true;
    PlotCurve steps{"objects", "#1f77b4", {}, true, true};
    for (std::size_t i = curve.threshold.size(); i-- > 0;)  // kept[i] for thresholds above threshold[i + 1]
        steps.points.push_back(
            {i + 1 < curve.threshold.size() ? place(curve.threshold[i + 1]) : plot.x_low, static_cast<double>(curve.kept[i])});
    steps.points.push_back({plot.x_high, static_cast<double>(curve.kept.front())});
    plot.curves.push_back(std::move(steps));
    plot.curves.push_back(
        {"automatic: " + std::to_string(curve.automatic_kept),
         "#d62728",
         {{place(curve.automatic_threshold), 0}, {place(curve.automatic_threshold), static_cast<double>(curve.automatic_kept)}},
         false,
         false});
    return plot;
}

std::string curves_extension(const std::string& path) {
    return known_extension(path, {".json", ".csv", ".svg"}, {"the format of the curves", "format of curves", ".csv, .svg or .json"});
}

}  // namespace

double reported_threshold(const VolumeInfo& info, const SelectionCurve& curve, double threshold) {
    return curve.size == "voxels" ? threshold : info.calibration.reported_difference(threshold);
}

void write_curves_json(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves) {
    JsonStream json(output_to(sink));
    json.begin_object().line().key("schema").value("isoatlas/curves/1").key("version").value(kVersion);
    put_volume(json, info);
    json.line().key("curves").begin_array();
    for (const SelectionCurve& curve : curves) {
        json.line().begin_object().key("size").value(curve.size).key("automatic").begin_object();
        json.key("threshold").value(reported_threshold(info, curve, curve.automatic_threshold)).key("kept").value(curve.automatic_kept);
        json.end_object().key("points").begin_array();
        for (std::size_t i = 0; i < curve.threshold.size(); ++i) {
            json.begin_array().value(reported_threshold(info, curve, curve.threshold[i])).value(curve.kept[i]).end_array();
        }
        json.end_array().end_object();
    }
    json.line().end_array().line().end_object().finish();
}

void write_curves_csv(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves) {
    ByteWriter out(sink);
    out.text("size,threshold,kept,automatic\n");
    for (const SelectionCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.threshold.size(); ++i) {
            out.text(curve.size + ",");
            out.number(reported_threshold(info, curve, curve.threshold[i]));
            out.text(",");
            out.number(curve.kept[i]);
            out.text(curve.threshold[i] == curve.automatic_threshold ? ",1\n" : ",0\n");
        }
    }
    out.finish();
}

void write_curves_svg(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves) {
    std::vector<Plot> plots;
    for (const SelectionCurve& curve : curves) plots.push_back(plot_of(info, curve));
    sink.write(svg_of(plots));
}

void write_curves(Sink& sink, const VolumeInfo& info, const std::vector<SelectionCurve>& curves) {
    const std::string extension = curves_extension(sink.name());
    if (extension == ".json") return write_curves_json(sink, info, curves);
    if (extension == ".csv") return write_curves_csv(sink, info, curves);
    write_curves_svg(sink, info, curves);
}

void write_curves(const std::string& path, const VolumeInfo& info, const std::vector<SelectionCurve>& curves) {
    (void)curves_extension(path);
    AtomicFile file(path);
    write_curves(file, info, curves);
    file.commit();
}

}  // namespace isoatlas
