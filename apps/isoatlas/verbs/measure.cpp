// isoatlas measure: sizes, shapes and values of objects; porosity, percolation and distribution of sizes of a volume.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "data/label_directory.h"
#include "data/sides.h"
#include "options/object_reference.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/measures_json.h"
#include "text/sizes.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kDefaultTop = 24;

/// What is printed: the objects in the order of the table, or of one isovalue.
struct Measured {
    bool are_labels = false;    ///< the labels of a label volume; nothing of the volume then
    std::optional<double> tau;  ///< stored; none: each object at its best isovalue
    Polarity polarity = Polarity::high;
    bool is_named = false;  ///< the objects that --object names
    std::vector<ObjectMeasures> objects;
    std::vector<std::string> references, notes;  ///< of the objects of the table, or of those that are named; else empty
    std::vector<Polarity> polarities;            ///< of the objects where they differ; else empty
    std::vector<double> isovalues;               ///< stored, of the porosity
    std::vector<std::int64_t> below;
    std::int64_t below_tau = 0;
    std::optional<Percolation> percolation;
};

/// The objects of the table, all those of one isovalue together.
void measure_table(const Arguments& arguments, Source& source, Measured& measured) {
    RankOptions options{.top = arguments.top > 0 ? arguments.top : kDefaultTop};
    if (arguments.selects) {
        options.selection = source.selection();
        if (arguments.top == 0) options.top = 0;
    }
    const ObjectTable table = source.objects(options);
    std::map<double, std::vector<std::int64_t>> at;
    for (const ObjectEntry& entry : table.entries) at[entry.best_tau].push_back(entry.id);
    std::map<std::pair<double, std::int64_t>, ObjectMeasures> found;
    for (const auto& [tau, ids] : at) {
        for (const ObjectMeasures& object : source.measure(tau, ids)) found[{tau, object.id}] = object;
    }
    const std::string side = polarity_of(source.info()) == Polarity::low ? "low" : "";
    for (const ObjectEntry& entry : table.entries) {
        measured.objects.push_back(found.at({entry.best_tau, entry.id}));
        measured.notes.push_back(entry.note);
        if (!arguments.selects) measured.references.push_back(side + std::to_string(measured.objects.size()));
    }
}

/// Each at its isovalue, in the order of the references.
void measure_named(const Arguments& arguments, Sides& sides, Measured& measured) {
    const std::vector<ChosenObject> chosen = sides.find(arguments.objects, arguments.tau);
    measured.is_named = true;
    for (const ChosenObject& object : chosen) {
        if (object.is_contour) {
            throw Error(ErrorKind::usage,
                        {.file = arguments.file,
                         .what = reference_of(object) + " is a cavity, which has no measures of its own",
                         .next = "isoatlas objects " + shell_word(arguments.file) + " --polarity low lists it as an object of low values"});
        }
        const std::vector<ObjectMeasures> found = sides.source(object).measure(object.tau, {object.voxel});
        measured.objects.push_back(found.at(0));
        measured.polarities.push_back(object.polarity);
        measured.references.push_back(reference_of(object, true));
        measured.notes.push_back(object.name);
    }
    measured.polarity = measured.polarities.front();
    if (std::ranges::count(measured.polarities, measured.polarity) == std::ssize(measured.polarities)) measured.polarities.clear();
}

void measure_labels(const Arguments& arguments, Source& source, Measured& measured) {
    measured.objects = source.measure_labels();
    if (arguments.objects.empty()) return;
    const std::vector<std::int64_t> labels = LabelDirectory(arguments, source).find(arguments.objects);
    std::erase_if(measured.objects, [&](const ObjectMeasures& object) { return std::ranges::find(labels, object.id) == labels.end(); });
}

/// Isovalues of the curve of porosity: every integer where there are few, else as many even steps.
std::vector<double> isovalues_over(const ValueRange& range, ValueType type) {
    constexpr int kSteps = 256;
    std::vector<double> taus;
    const bool each = !is_floating(type) && range.high - range.low < kSteps;
    const double step = each ? 1 : (range.high - range.low) / kSteps;
    if (!(step > 0)) return {range.low};
    for (int i = 0; i <= kSteps && range.low + i * step <= range.high; ++i) taus.push_back(range.low + i * step);
    return taus;
}

void measure_volume(const Arguments& arguments, Source& source, Measured& measured) {
    measured.isovalues = isovalues_over(source.range(), source.info().type);
    measured.below = source.samples_below(measured.isovalues);
    if (polarity_of(source.info()) == Polarity::low) std::ranges::reverse(measured.isovalues), std::ranges::reverse(measured.below);
    if (measured.tau) measured.below_tau = source.samples_below({*measured.tau})[0];
    if (!arguments.no_percolation) measured.percolation = source.percolation();
}

/// Of an object. info: of measured.polarity.
VolumeInfo info_of(const Measured& measured, std::size_t object, const VolumeInfo& info) {
    return measured.polarities.empty() || measured.polarities[object] == measured.polarity ? info : negated(info);
}

// JSON

void print_json(Terminal& terminal, Source& source, const Measured& measured, std::int64_t shown) {
    const VolumeInfo& info = source.info();
    const Calibration& calibration = info.calibration;
    Json head = document("measure", info, source.interpolant(), source.tunnel_height());
    if (!measured.polarities.empty()) head["polarity"] = name_of(PolarityChoice::both);
    head["tau"] = measured.tau ? Json(calibration.reported(*measured.tau)) : Json(nullptr);
    head["objects_are"] = measured.are_labels ? "labels" : "objects";
    head["samples"] = info.extent.voxels();
    head["below_tau"] = measured.tau ? Json(measured.below_tau) : Json(nullptr);
    Json taus = Json::array();
    for (const double tau : measured.isovalues) taus.push_back(calibration.reported(tau));
    head["porosity"] = {{"tau", std::move(taus)}, {"below", measured.below}};
    head["percolation"] = measured.percolation ? percolation_json(*measured.percolation, info) : Json(nullptr);
    head["sizes"] = measured.tau || measured.are_labels ? sizes_json(size_distribution(measured.objects)) : Json(nullptr);
    add_reads(head, source.reads());
    print(terminal, head, "objects", shown, [&](std::int64_t i) {
        Json json = measures_json(measured.objects[static_cast<std::size_t>(i)], info_of(measured, static_cast<std::size_t>(i), info));
        if (!measured.polarities.empty()) json["polarity"] = name_of(measured.polarities[static_cast<std::size_t>(i)]);
        json["reference"] = measured.references.empty() ? Json(nullptr) : Json(measured.references[static_cast<std::size_t>(i)]);
        json["note"] = measured.notes.empty() ? "" : measured.notes[static_cast<std::size_t>(i)];
        return json;
    });
}

// Text

std::string measure_text(double size) {
    if (!std::isfinite(size)) return "-";
    return size < 1000 ? fmt::format("{:.4g}", size) : count_text(std::llround(size));
}

std::string with_unit(const std::string& title, const std::string& unit) { return unit.empty() ? title : title + " [" + unit + "]"; }

std::string measured_note(const Measured& measured, std::size_t i) {
    std::string note = measured.notes.empty() ? "" : measured.notes[i];
    const ObjectMeasures& object = measured.objects[i];
    const std::int64_t pieces = object.euler + object.tunnels - object.cavities;
    if (pieces > 1) note = counted(pieces, "piece");
    if (object.touches_border) note += note.empty() ? "reaches the border" : ", reaches the border";
    return note;
}

/// As many as are the same on every processor: thickness comes from rays in single precision.
double three_digits(double value) { return std::isfinite(value) ? std::stod(fmt::format("{:.3g}", value)) : value; }

void print_objects(Terminal& terminal, const VolumeInfo& info, const Measured& measured, std::int64_t shown, bool thickness) {
    const bool flat = info.extent.rank == 2;
    double largest = 0;
    for (const ObjectMeasures& object : measured.objects) largest = std::max(largest, object.volume);
    const MeasureUnit unit = measure_unit(info, largest);
    const std::string& length = info.geometry.unit;
    std::vector<Table::Column> columns{{"#"}, {"id"}};
    if (measured.are_labels) columns = {{"label"}};
    const bool has_taus = !measured.tau && !measured.are_labels;
    if (has_taus) columns.push_back({"tau"});
    columns.push_back({with_unit(flat ? "area" : "volume", unit.name)});
    columns.push_back({flat ? with_unit("length", length) : with_unit("area", length.empty() ? "" : length + "²")});
    columns.push_back({with_unit("Feret", length)});
    columns.push_back({"min"});
    columns.push_back({flat ? "circularity" : "sphericity"});
    if (thickness) columns.push_back({with_unit("thickness", length)});
    if (!measured.are_labels) columns.push_back({with_unit("mean", info.value_unit)});
    columns.push_back({flat ? "holes" : "tunnels"});
    if (!flat) columns.push_back({"cavities"});
    columns.push_back({"note", true});
    Table text(columns);
    for (std::size_t i = 0; i < static_cast<std::size_t>(shown); ++i) {
        const ObjectMeasures& object = measured.objects[i];
        std::vector<std::string> row{measured.are_labels ? std::to_string(object.id)
                                     : measured.is_named ? measured.references[i]
                                                         : std::to_string(i + 1)};
        if (!measured.are_labels) row.push_back(voxel_word(object.id));
        if (has_taus) row.push_back(Scale(info_of(measured, i, info)).brief(object.tau));
        row.insert(row.end(), {measure_text(object.volume * unit.factor), measure_text(object.area), measure_text(object.feret.max),
                               measure_text(object.feret.min), fmt::format("{:.3f}", object.sphericity)});
        if (thickness) row.push_back(measure_text(three_digits(object.thickness.median)));
        if (!measured.are_labels) row.push_back(measure_text(object.values.mean));
        row.push_back(object.tunnels == 0 ? "-" : count_text(object.tunnels));
        if (!flat) row.push_back(object.cavities == 0 ? "-" : count_text(object.cavities));
        row.push_back(measured_note(measured, i));
        text.add(row);
    }
    text.print(terminal);
}

std::string along_axes(const Vec3& taus, const VolumeInfo& info) {
    const Scale scale(info);
    std::string text;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(info.extent.rank); ++axis)
        text += fmt::format("{}{} along {}", axis > 0 ? ", " : "", scale.brief(taus[axis]), "xyz"[axis]);
    return text;
}

void print_volume(Terminal& terminal, const VolumeInfo& info, const Measured& measured) {
    if (measured.tau) {
        const double percent = 100 * static_cast<double>(measured.below_tau) / static_cast<double>(info.extent.voxels());
        terminal.out() << fmt::format("\nporosity: {:.4g} % of the samples are below {}, {:.4g} % are not\n", percent,
                                      Scale(info).brief(*measured.tau), 100 - percent);
        const SizeDistribution sizes = size_distribution(measured.objects);
        const auto quantiles = [&](const SizeQuantiles& q) {
            return fmt::format("{} (10 %), {} (50 %), {} (90 %)", measure_text(q[0]), measure_text(q[2]), measure_text(q[4]));
        };
        terminal.out() << fmt::format("diameters{} of {}: {}; by volume {}\n",
                                      info.geometry.unit.empty() ? "" : " in " + info.geometry.unit, counted(sizes.objects, "object"),
                                      quantiles(sizes.by_number), quantiles(sizes.by_volume));
    }
    if (!measured.percolation) return;
    terminal.out() << fmt::format("{}high values percolate up to {}\n", measured.tau ? "" : "\n",
                                  along_axes(measured.percolation->high, info));
    terminal.out() << fmt::format("low values percolate above {}\n", along_axes(measured.percolation->low, info));
}

void check_measure(const Arguments& arguments) {
    if (arguments.selects && (arguments.tau || !arguments.objects.empty())) {
        throw Error(ErrorKind::usage,
                    {.what = "a selection applies to the table of best isovalues, not to one isovalue or to named objects",
                     .next = "omit --tau and --object, or the selection"});
    }
    if (!arguments.output.empty()) check_output(arguments, {".csv"});
}

Measured measure(const Arguments& arguments, Sides& sides) {
    Source& source = sides.main();
    Measured measured;
    measured.polarity = sides.polarity();
    measured.are_labels = arguments.inputs.are_labels && !arguments.tau && !arguments.selects;
    if (measured.are_labels) {
        measure_labels(arguments, source, measured);
        return measured;
    }
    if (!arguments.objects.empty()) {
        measure_named(arguments, sides, measured);
        return measured;
    }
    if (arguments.tau) {
        measured.tau = source.tau();
        measured.objects = source.measure(*measured.tau, {});
    } else {
        measure_table(arguments, source, measured);
    }
    measure_volume(arguments, source, measured);
    return measured;
}

}  // namespace

int run_measure(const Arguments& arguments, Terminal& terminal) {
    check_measure(arguments);
    Sides sides(arguments, terminal);
    if (arguments.thickness && sides.main().info().extent.rank == 2)
        throw Error(ErrorKind::usage, {.file = arguments.file, .what = "--thickness is of 3D volumes, this one is 2D", .next = "omit it"});
    const Measured measured = measure(arguments, sides);
    Source& source = sides.source(measured.polarity);
    stop_if_interrupted();
    const auto all = static_cast<std::int64_t>(measured.objects.size());
    if (!arguments.output.empty()) {
        const WritingGuard guard;
        write_measures(arguments.output, source.info(), measured.objects, measured.polarities);
    }
    if (arguments.json) {
        print_json(terminal, source, measured,
                   (measured.tau || measured.are_labels) && arguments.top > 0 ? std::min(all, arguments.top) : all);
        return 0;
    }
    const std::int64_t most = arguments.top > 0 ? arguments.top : measured.tau ? kDefaultTop : all;
    const std::int64_t shown = measured.tau || measured.are_labels ? std::min(all, most) : all;
    print_objects(terminal, source.info(), measured, shown, arguments.thickness);
    if (shown < all) terminal.say(fmt::format("and {} more", count_text(all - shown)));
    print_volume(terminal, source.info(), measured);
    if (arguments.output.empty()) {
        std::string what = measured.tau ? fmt::format(" --tau {}", *arguments.tau) : "";
        if (measured.is_named) {
            for (const std::string& reference : measured.references) what += " --object " + reference;
        }
        terminal.next(fmt::format("isoatlas measure {}{}{} -o measures.csv    # all measures of all of them", shell_word(arguments.file),
                                  reading_options(arguments), what));
    }
    return 0;
}

}  // namespace isoatlas::cli
