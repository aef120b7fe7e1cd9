// write_spectrum: the extension chooses the format.
#include "base/atomic_file.h"
#include "formats/common/connectivity.h"
#include "formats/common/file_extension.h"
#include "formats/common/generator.h"
#include "formats/tree/spectrum_columns.h"
#include "formats/tree/spectrum_formats.h"
#include "formats/volume/volume_json.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

/// Pairs of the lowest and the highest.
void put_ranges(JsonStream& json, const char* key, const CountRange& range) {
    const auto put = [&](const char* name, std::int64_t LevelCounts::* count) {
        json.key(name).begin_array().value(range.min.*count).value(range.max.*count).end_array();
    };
    json.key(key).begin_object();
    put("objects", &LevelCounts::objects);
    put("contours", &LevelCounts::contours);
    put("tunnels", &LevelCounts::tunnels);
    put("cavities", &LevelCounts::cavities);
    json.end_object();
}

void put_intervals(JsonStream& json, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options) {
    json.line().key("interval_count").value(spectrum.intervals.size()).line().key("intervals").begin_array();
    for (const SpectrumColumn& column : spectrum_columns(spectrum, options.max_intervals)) {
        const auto [low, high] = info.calibration.reported_interval(column.low, column.high);
        json.line().begin_object().key("low").value(low);
        json.key("high").value(high).key("merged").value(column.intervals);
        put_ranges(json, "all", column.all);
        put_ranges(json, "significant", column.significant);
        json.end_object();
    }
    json.line().end_array();
}

void put_sizes(JsonStream& json, const VolumeInfo& info, const Spectrum& spectrum) {
    json.line().key("sizes").begin_array();
    for (const SpectrumSize& size : spectrum.sizes) {
        json.line().begin_object().key("tau").value(info.calibration.reported(size.tau));
        json.key("voxels").begin_object().key("min").value(size.voxels.min).key("max").value(size.voxels.max).end_object();
        json.key("cells").value(size.cells).key(info.extent.rank == 3 ? "triangles" : "segments").value(size.facets);
        json.key("area").value(size.area).key("measure").value(size.measure).end_object();
    }
    json.line().end_array();
}

void put_advice(JsonStream& json, const VolumeInfo& info, const Spectrum& spectrum) {
    json.line().key("advice").begin_array();
    for (const SpectrumAdvice& advice : spectrum.advice) {
        json.line().begin_object().key("tau").value(info.calibration.reported(advice.tau)).key("object").value(advice.object);
        json.key("reason");
        advice.reason ? json.value(name_of(*advice.reason)) : json.null();
        if (advice.reason == IsovalueReason::inner) json.key("cavity").value(advice.cavity);
        json.key("note").value(advice.note).end_object();
    }
    json.line().end_array();
}

std::string spectrum_extension(const std::string& path) {
    return known_extension(path, {".json", ".csv", ".svg"}, {"the format of the spectrum", "format of a spectrum", ".csv, .svg or .json"});
}

}  // namespace

void write_spectrum_json(const JsonStream::Output& output, const VolumeInfo& info, const Spectrum& spectrum,
                         const SpectrumOutput& options) {
    JsonStream json(output);
    json.begin_object().line().key("schema").value("isoatlas/spectrum/3").key("version").value(kVersion);
    put_members(json.line(), connectivity_of(info, spectrum.interpolant, spectrum.tunnel_height));
    json.key("boundary").value("closed");
    put_volume(json, info);
    json.line().key("selected").value(spectrum.selected);
    put_advice(json, info, spectrum);
    put_sizes(json, info, spectrum);
    put_intervals(json, info, spectrum, options);
    json.line().end_object().finish();
}

void write_spectrum(Sink& sink, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options) {
    const std::string extension = spectrum_extension(sink.name());
    if (extension == ".csv") return write_spectrum_csv(sink, info, spectrum);
    if (extension == ".svg") return write_spectrum_svg(sink, info, spectrum);
    write_spectrum_json(output_to(sink), info, spectrum, options);
}

void write_spectrum(const std::string& path, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options) {
    (void)spectrum_extension(path);
    AtomicFile file(path);
    write_spectrum(file, info, spectrum, options);
    file.commit();
}

void write_spectrum_json(std::ostream& out, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options) {
    write_spectrum_json(output_to(out, "the spectrum"), info, spectrum, options);
}

}  // namespace isoatlas
