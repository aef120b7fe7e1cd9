// isoatlas info: describes a file and the cost of its analysis.
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "data/session.h"
#include "data/several.h"
#include "data/source.h"
#include "text/choices.h"
#include "text/document.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Above this many bytes of samples the values are not read, to keep `info` fast.
constexpr double kReadLimit = 2e9;

struct Values {
    bool known = false;
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();  ///< stored
    std::int64_t missing = 0;                                                                               ///< NaN and infinite samples
    std::optional<SampleSurvey> survey;                                                                     ///< of volume files
    std::optional<FillValue> fill;
    double noise = 0, sigma = 0;  ///< stored; advised_sigma()
};

/// The range without a fill value.
std::pair<double, double> range_of(const Values& values) {
    return values.fill ? std::pair(values.fill->low, values.fill->high) : std::pair(values.low, values.high);
}

Values read_values(VolumeReader& reader, Session& session) {
    const VolumeInfo& info = reader.info();
    Values values;
    const auto bytes = static_cast<double>(info.extent.voxels()) * static_cast<double>(size_of(info.type));
    if (bytes > kReadLimit) return values;
    values.survey = survey_samples(reader, session.context());
    values.low = values.survey->low.value, values.high = values.survey->high.value, values.missing = values.survey->missing;
    values.known = values.low <= values.high;
    if (!values.known) return values;
    values.fill = fill_value(*values.survey, info);
    if (values.survey->likeness.are_labels) return values;
    values.noise = independent_noise(reader, *values.survey, values.fill);
    const auto [low, high] = range_of(values);
    values.sigma = advised_sigma(info, values.noise, high - low);
    return values;
}

Json json_of(const Bounds& bounds) { return {{"min", bounds.min}, {"max", bounds.max}}; }

Json to_json(const SurfacePreview& preview, double tau) {
    return {{"tau", tau},
            {"objects", preview.objects},
            {"contours", preview.contours},
            {"tunnels", preview.tunnels},
            {"voxels", json_of(preview.voxels)},
            {"active_cells", json_of(preview.cells)},
            {"points", json_of(preview.points)},
            {"triangles", json_of(preview.triangles)},
            {"bricks", json_of(preview.bricks)},
            {"bytes", json_of(preview.bytes)},
            {"extents", json_of(preview.extents)}};
}

/// "1,234", or "1,200 to 1,300".
std::string text_of(const Bounds& bounds) {
    if (bounds.min == bounds.max) return count_text(bounds.min);
    return count_text(bounds.min) + " to " + count_text(bounds.max);
}

void print_preview(std::ostream& out, const SurfacePreview& preview, double tau) {
    out << fmt::format("surface      at {}: {}, {}, {}\n", tau, counted(preview.objects, "object"), counted(preview.contours, "contour"),
                       counted(preview.tunnels, "tunnel"));
    out << "             voxels inside " << text_of(preview.voxels) << "; active cells " << text_of(preview.cells) << "\n";
    out << "             points " << text_of(preview.points) << "; triangles " << text_of(preview.triangles)
        << " (compact, without articulation points)\n";
    out << "to be read   bytes " << text_of(preview.bytes) << " in " << text_of(preview.extents) << " reads, bricks "
        << text_of(preview.bricks) << '\n';
}

/// What the samples look like.
void add_survey(Json& json, const VolumeInfo& info, const Values& values) {
    Json& entry = json["survey"] = nullptr;
    if (!values.survey || !values.known) return;
    const LabelLikeness& like = values.survey->likeness;
    const auto [low, high] = range_of(values);
    entry = {{"fill_value", nullptr}, {"values", values.survey->values == 0 ? Json(nullptr) : Json(values.survey->values)}};
    if (values.fill) {
        entry["fill_value"] = {{"stored", values.fill->value},
                               {"samples", values.fill->count},
                               {"low", info.calibration.reported(values.fill->low)},
                               {"high", info.calibration.reported(values.fill->high)}};
    }
    entry["labels"] = like.are_labels;
    entry["equal_neighbours"] = values.survey->values == 0 ? Json(nullptr) : Json(like.equal);
    entry["noise"] = info.calibration.reported_difference(values.noise);
    entry["noise_part"] = high > low ? values.noise / (high - low) : 0;
    entry["advised_gaussian"] = values.sigma > 0 ? Json(values.sigma) : Json(nullptr);
}

/// What else the file holds.
void add_volumes(Json& json, const VolumeInfo& info) {
    const FileVolumes& volumes = info.volumes;
    json["channels"] = {{"names", volumes.channels}, {"channel", volumes.channel}};
    json["time_steps"] = {{"count", volumes.time_steps},
                          {"time_step", volumes.time_step},
                          {"times", volumes.times},
                          {"unit", volumes.time_unit.empty() ? Json(nullptr) : Json(volumes.time_unit)}};
    json["levels"] = {{"sizes", volumes.levels}, {"level", volumes.level}};
    json["chunk"] = info.chunk[0] > 0 ? Json(info.chunk) : Json(nullptr);
}

Json to_json(const VolumeInfo& info, const Values& values, const Cost& cost) {
    Json json = document("info", info);
    json["file"] = {
        {"bytes", info.file_bytes}, {"data_file", info.data_file}, {"big_endian", info.big_endian}, {"slab_readable", info.slab_readable}};
    json["description"] = info.description;
    json["voxels"] = info.extent.voxels();
    Json range = nullptr;
    if (values.known) {
        const double a = info.calibration.reported(values.low), b = info.calibration.reported(values.high);
        range = {{"low", std::min(a, b)}, {"high", std::max(a, b)}, {"stored_low", values.low}, {"stored_high", values.high}};
    }
    json["values"] = range;
    json["missing_samples"] = values.known || values.missing > 0 ? Json(values.missing) : Json(nullptr);
    add_survey(json, info, values);
    add_volumes(json, info);
    const auto bytes = [](double count) { return static_cast<std::int64_t>(count); };
    json["estimate"] = {{"memory_bytes", {{"smooth", bytes(cost.memory_smooth)}, {"noise", bytes(cost.memory_noise)}}},
                        {"seconds", {{"smooth", cost.seconds_smooth}, {"noise", cost.seconds_noise}}}};
    return json;
}

std::string vector_text(const Vec3& v, int rank) {
    return rank == 2 ? fmt::format("{:.7g}, {:.7g}", v[0], v[1]) : fmt::format("{:.7g}, {:.7g}, {:.7g}", v[0], v[1], v[2]);
}

void print_geometry(std::ostream& out, const VolumeInfo& info) {
    const Geometry& geometry = info.geometry;
    const std::string unit = geometry.unit.empty() ? "" : " " + geometry.unit;
    const std::string no_unit = geometry.unit.empty() ? "  (no unit; --unit names one)" : "";
    Vec3 size{};
    for (std::size_t axis = 0; axis < 3; ++axis) size[axis] = geometry.spacing[axis] * static_cast<double>(info.extent.size[axis]);
    if (geometry.coordinates[0].empty()) {
        out << "spacing      " << vector_text(geometry.spacing, info.extent.rank) << unit << no_unit << '\n';
        out << "size         " << vector_text(size, info.extent.rank) << unit << '\n';
    } else {
        out << "spacing      rectilinear: one coordinate per sample and axis" << unit << '\n';
    }
    out << "origin       " << vector_text(geometry.origin, info.extent.rank) << unit << '\n';
    out << "space        " << geometry.space << (handedness(geometry) < 0 ? " (mirrored axes)" : "") << '\n';
}

void print_survey(std::ostream& out, const VolumeInfo& info, const Values& values) {
    if (!values.survey || !values.known) return;
    const Scale scale(info);
    const auto percent = [](double part) { return fmt::format("{:.2g} %", 100 * part); };
    if (values.fill) {
        out << "fill value   " << scale.text(values.fill->value) << " looks like one: " << counted(values.fill->count, "sample")
            << "; the others are " << scale.brief(values.fill->low) << " .. " << scale.brief(values.fill->high)
            << "; it counts as missing unless --no-data none is given\n";
    }
    if (values.survey->likeness.are_labels) {
        out << "labels       " << values.survey->values << " whole numbers, " << percent(values.survey->likeness.equal)
            << " of the neighbours are equal: taken for labels unless --labels no is given\n";
        return;
    }
    const auto [low, high] = range_of(values);
    if (values.noise > 0 && high > low) {
        out << fmt::format("noise        about {:.3g}, {} of the range", info.calibration.reported_difference(values.noise),
                           percent(values.noise / (high - low)))
            << (values.sigma > 0 ? fmt::format(": --gaussian auto (sigma {}) smooths it", values.sigma) : "") << '\n';
    }
}

/// "0 DAPI, 1 GFP": each line says which one is described here.
void print_volumes(std::ostream& out, const VolumeInfo& info) {
    constexpr std::size_t kMostNames = 32;
    const FileVolumes& volumes = info.volumes;
    if (volumes.channels.size() > 1) {
        out << "channels     " << volumes.channels.size() << ":";
        for (std::size_t i = 0; i < std::min(volumes.channels.size(), kMostNames); ++i)
            out << (i > 0 ? ", " : " ") << i << (volumes.channels[i].empty() ? "" : " " + volumes.channels[i]);
        out << (volumes.channels.size() > kMostNames ? ", ..." : "") << "; this is " << volumes.channel << '\n';
    }
    if (volumes.time_steps > 1) {
        out << "time steps   0 to " << volumes.time_steps - 1 << "; this is " << volumes.time_step;
        const auto step = static_cast<std::size_t>(volumes.time_step);
        if (step < volumes.times.size()) out << fmt::format(", at {:.6g} {}", volumes.times[step], volumes.time_unit);
        out << '\n';
    }
    if (volumes.levels.size() > 1) {
        out << "levels       ";
        for (std::size_t i = 0; i < volumes.levels.size(); ++i)
            out << (i > 0 ? ", " : "") << i << " " << extent_text({.rank = info.extent.rank, .size = volumes.levels[i]});
        out << "; this is " << volumes.level << '\n';
    }
}

void print_text(Terminal& terminal, const VolumeInfo& info, const Values& values, const Arguments& arguments) {
    std::ostream& out = terminal.out();
    out << terminal.bold(shown_name(info.path)) << '\n';
    out << "format       " << info.format << ", " << info.encoding << (info.big_endian ? ", big endian" : "")
        << (info.data_file.empty() ? "" : ", samples in " + shown_name(info.data_file)) << '\n';
    if (!info.description.empty()) out << "description  " << info.description << '\n';
    out << "samples      " << extent_text(info.extent) << "  " << name_of(info.type) << "  (" << count_text(info.extent.voxels())
        << " voxels, " << bytes_text(static_cast<double>(info.file_bytes)) << " on disk)\n";
    print_volumes(out, info);
    print_geometry(out, info);
    const Scale scale(info);
    if (!info.calibration.is_linear_identity()) {
        out << fmt::format("calibration  value = {:.9g} * stored + {:.9g}\n", info.calibration.slope, info.calibration.intercept);
    }
    if (values.known) {
        const bool reversed = (info.calibration.slope < 0) != scale.is_low();
        out << "values       " << scale.brief(reversed ? values.high : values.low) << " .. "
            << scale.brief(reversed ? values.low : values.high) << (info.value_unit.empty() ? "" : " " + info.value_unit) << '\n';
    }
    if (values.missing > 0)
        out << "missing      " << counted(values.missing, "sample") << " NaN or infinite: analyse with --missing below\n";
    print_survey(out, info, values);
    for (const std::string& note : info.notes) out << "note         " << note << '\n';
    out << "analysis     " << cost_text(info, arguments.threads) << '\n';
}

[[noreturn]] void refuse_tau(const Arguments& arguments) {
    throw Error(ErrorKind::usage, {.file = arguments.file,
                                   .what = "--tau previews a surface, which requires a store",
                                   .next = "isoatlas build " + shell_word(arguments.file) + " -o FILE.atlas; or isoatlas objects --tau T"});
}

/// A file of several things that share no grid is a list of them.
int list_choices(const Error& error, const Arguments& arguments, Terminal& terminal) {
    std::vector<std::string> words{"info", arguments.file};
    if (arguments.open.follow_links) words.emplace_back("--follow-links");
    const std::vector<ChoiceCommand> choices = commands_of(error, words);
    if (arguments.json) {
        Json json = document("choices");
        json["file"] = error.text().file;
        json["what"] = error.text().what;
        json["choices"] = json_of(choices);
        print(terminal, json);
        return 0;
    }
    terminal.out() << terminal.bold(shown_name(arguments.file)) << ": " << error.text().what << '\n' << lines_of(choices);
    return 0;
}

/// Of a collection of stores.
FileVolumes volumes_of(const Several& several) {
    const Channels& channels = several.channels;
    FileVolumes volumes;
    if (channels.names.size() > 1) volumes.channels = channels.names;
    volumes.channel = channels.channel_of(several.first);
    volumes.time_steps = channels.time_steps;
    volumes.time_step = channels.time_step_of(several.first);
    volumes.times = channels.times;
    volumes.time_unit = channels.time_unit;
    return volumes;
}

int describe_input(Arguments arguments, Terminal& terminal) {
    Session session(arguments, terminal);
    VolumeInfo info;
    Values values;
    std::optional<SurfacePreview> preview;
    if (is_atlas(arguments.file)) {
        const Atlas atlas(arguments.file, {.corrections = corrections_of(arguments)});
        check_store_options(arguments, atlas);
        const std::array<double, 2> range = atlas.range();
        info = atlas.info();
        if (arguments.several) info.volumes = volumes_of(*arguments.several);
        info.notes.push_back("built with " + interpolant_text(info, atlas.interpolant(), atlas.tunnel_height()) +
                             polarities_text(atlas.polarities()));
        values.known = true, values.low = range[0], values.high = range[1];
        if (arguments.tau) preview = atlas.preview(Scale(info).stored(*arguments.tau));
    } else {
        if (arguments.tau) refuse_tau(arguments);
        std::vector<std::string> notes;
        const std::unique_ptr<VolumeReader> reader = open_first(arguments, notes);
        info = reader->info();
        values = read_values(*reader, session);
        info.notes = reader->info().notes;  // notes found at the end of the file
        info.notes.insert(info.notes.end(), notes.begin(), notes.end());
    }
    if (arguments.voxel_units) info.geometry = Geometry{};
    if (arguments.json) {
        Json json = to_json(info, values, cost_of_analysis(info, arguments.threads));
        if (preview) json["preview"] = to_json(*preview, *arguments.tau);
        print(terminal, json);
        return 0;
    }
    print_text(terminal, info, values, arguments);
    if (preview) print_preview(terminal.out(), *preview, *arguments.tau);
    terminal.next("isoatlas objects " + shell_word(arguments.file) + reading_options(arguments));
    return 0;
}

}  // namespace

int run_info(const Arguments& arguments, Terminal& terminal) {
    try {
        return describe_input(arguments, terminal);
    } catch (const Error& error) {
        if (error.reason() != Reason::dataset_needed && error.reason() != Reason::series_needed) throw;
        return list_choices(error, arguments, terminal);
    }
}

}  // namespace isoatlas::cli
