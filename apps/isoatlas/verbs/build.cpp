// isoatlas build: a volume, its trees and its bricks in one file, from which any surface is extracted without reading the rest.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "data/input.h"
#include "data/session.h"
#include "data/store_beside.h"
#include "options/parse_errors.h"
#include "options/suggest.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Lowest and highest sample of the file, read slab by slab.
ValueRange range_of(VolumeReader& reader) {
    const VolumeInfo& info = reader.info();
    ValueRange range{INFINITY, -INFINITY};
    std::vector<std::byte> slice(static_cast<std::size_t>(info.extent.slice()) * size_of(info.type));
    for (std::int64_t z = 0; z < info.extent.size[2]; ++z) {
        stop_if_interrupted();
        reader.read(z, z + 1, slice);
        visit_type(info.type, [&]<class T>(T) {
            const std::span<const T> samples(reinterpret_cast<const T*>(slice.data()), slice.size() / sizeof(T));
            for (const T sample : samples) {
                if (!std::isfinite(static_cast<double>(sample))) continue;
                range.low = std::min(range.low, static_cast<double>(sample));
                range.high = std::max(range.high, static_cast<double>(sample));
            }
        });
    }
    return range;
}

Json estimate_json(const BuildEstimate& estimate) {
    Json json;
    json["critical_elements"] = estimate.critical_elements;
    json["memory"] = estimate.memory;
    json["min_memory"] = estimate.min_memory;
    json["budget"] = estimate.budget;
    json["uses_scratch"] = estimate.uses_scratch;
    json["disk"] = estimate.disk;
    json["disk_free"] = estimate.disk_free;
    json["store_bytes"] = estimate.store_bytes;
    json["seconds"] = estimate.seconds;
    return json;
}

/// Prints the estimate of a build; throws where the build would.
int dry_run(const Arguments& arguments, Terminal& terminal, VolumeReader& reader, BuildOptions options) {
    const std::string store = arguments.output.empty() ? stem_of(arguments) + ".atlas" : arguments.output;
    if (options.tunnel_height_percent > 0) {  // of the unfiltered samples: accurate enough to count elements
        const ValueRange range = range_of(reader);
        options.analysis.tunnel_height = options.tunnel_height_percent / 100 * (range.high - range.low);
    }
    const BuildEstimate estimate = estimate_build(reader, store, options, arguments.threads);
    check_estimate(estimate, reader.info().path, store);
    if (arguments.json) {
        Json json = document("build", reader.info(), options.analysis.interpolant, options.analysis.tunnel_height);
        json["estimate"] = estimate_json(estimate);
        print(terminal, json);
    } else {
        const auto bytes = [](std::int64_t count) { return bytes_text(static_cast<double>(count)); };
        terminal.out() << "critical elements  about " << count_text(estimate.critical_elements) << '\n'
                       << "memory             " << bytes(std::min(estimate.memory, estimate.budget)) << " of a budget of "
                       << bytes(estimate.budget) << " (at least " << bytes(estimate.min_memory) << ")"
                       << (estimate.uses_scratch ? ", the rest in a scratch file" : "") << '\n'
                       << "disk               " << bytes(estimate.disk) << " while it runs, " << bytes(estimate.store_bytes)
                       << " in the end; " << bytes(estimate.disk_free) << " are free\n"
                       << "time               " << seconds_text(estimate.seconds) << '\n';
    }
    return 0;
}

/// Lists foreign files in the folder, as the end of a sentence.
std::string others_in(const std::string& folder) {
    std::string names;
    std::error_code failed;
    for (std::filesystem::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        const std::string name = at->path().filename().string();
        if (name != "lock") names += (names.empty() ? "" : ", ") + name;
        if (names.size() > 200) break;
    }
    return names.empty() ? ": remove it" : ": it holds " + names + ", not written by a build";
}

void print_report(const Arguments& arguments, Terminal& terminal, const VolumeInfo& info, const BuildReport& report) {
    const Atlas atlas(arguments.output);
    const auto voxels = static_cast<double>(info.extent.voxels()), bytes = static_cast<double>(report.bytes);
    const double raw = voxels * static_cast<double>(size_of(info.type));
    if (arguments.json) {
        VolumeInfo described = atlas.info();
        described.notes = info.notes;
        described.notes.insert(described.notes.end(), arguments.inputs.assumed.begin(), arguments.inputs.assumed.end());
        Json json = document("build", described, atlas.interpolant(), atlas.tunnel_height());
        json["output"] = arguments.output;
        json["bytes"] = report.bytes;
        json["polarities"] = name_of(atlas.polarities());
        json["sample_bytes"] = static_cast<std::int64_t>(raw);
        json["resumed"] = report.resumed;
        json["not_used"] = report.not_used;
        json["peak_memory"] = report.peak_memory;
        json["left_behind"] = report.left_behind;
        print(terminal, json);
        return;
    }
    terminal.out() << shown_name(arguments.output) << ": " << bytes_text(bytes) << ", " << fmt::format("{:.3g}", bytes / voxels)
                   << " bytes a voxel (" << bytes_text(raw) << " of samples), "
                   << interpolant_text(atlas.info(), atlas.interpolant(), atlas.tunnel_height()) << polarities_text(atlas.polarities())
                   << '\n';
    terminal.next("isoatlas objects " + shell_word(arguments.output));
}

/// A store has its samples once, so what lies below all others for one polarity does for the other.
void check_missing_of_both(const Arguments& arguments) {
    if (arguments.polarity != PolarityChoice::both) return;
    if (arguments.inputs.missing_of_low) {
        throw Error(ErrorKind::usage, {.file = arguments.file,
                                       .what = fmt::format("{} looks like a fill value, and would be an object of low values",
                                                           *arguments.inputs.missing_of_low->no_data),
                                       .expected = "samples without fill values",
                                       .next = "give a value for it: --missing VALUE --no-data " +
                                               fmt::format("{}", *arguments.inputs.missing_of_low->no_data) +
                                               ", build each polarity alone, or take it as a value: --no-data none"});
    }
    if (arguments.missing.action != MissingPolicy::Action::below) return;
    throw Error(ErrorKind::usage, {.what = "--missing below would make missing samples objects of low values",
                                   .next = "give a value: --missing VALUE, or build each polarity alone"});
}

}  // namespace

BuildOptions build_options(const Arguments& arguments, const VolumeInfo& info) {
    BuildOptions options;
    options.analysis.interpolant = arguments.interpolant;
    options.missing = arguments.missing;
    options.memory = arguments.memory;
    options.restart = arguments.restart;
    options.gaussian = arguments.gaussian.value_or(0);
    options.time_step = arguments.open.time_step;
    options.is_replaceable = arguments.verb != "build";
    options.polarities = arguments.polarity.value_or(PolarityChoice::high);
    if (arguments.voxel_units) options.geometry = voxel_geometry();
    if (arguments.tunnel_height_in_percent) {
        options.tunnel_height_percent = arguments.tunnel_height;
    } else if (arguments.tunnel_height > 0) {
        options.analysis.tunnel_height = arguments.tunnel_height / std::abs(info.calibration.slope);
    }
    return options;
}

BuildReport build_store(const Arguments& arguments, Terminal& terminal, VolumeReader& reader,
                        const std::function<void(const Progress&)>& watch,
                        const std::function<void(const std::string&, const Context&)>& high_values) {
    check_missing_of_both(arguments);
    BuildReport report;
    {
        Session session(arguments, terminal);
        Context context = session.context();
        context.progress = [&watch, bar = context.progress](const Progress& progress) {
            bar(progress);
            if (watch) watch(progress);
        };
        const WritingGuard guard("stopped: finished phases are kept; the same command resumes, --restart starts over");
        BuildOptions options = build_options(arguments, reader.info());
        options.high_values = high_values;
        report = build_atlas(arguments.output, reader, options, context);
    }
    for (const std::string& note : reader.info().notes) terminal.say("note: " + note);
    for (const std::string& phases : report.not_used) terminal.say("note: " + phases);
    for (const std::string& phase : report.resumed) terminal.say("note: the phase \"" + phase + "\" was finished by an earlier build");
    if (!report.left_behind.empty())
        terminal.say("note: the store is complete; " + report.left_behind + " stays" + others_in(report.left_behind));
    return report;
}

int run_build(const Arguments& arguments, Terminal& terminal) {
    if (builds_all(arguments)) return run_build_all(arguments, terminal);
    if (!arguments.output.empty()) {
        check_output(arguments, {".atlas"});
    } else if (!arguments.dry_run) {
        usage("`isoatlas build` needs --output FILE", "isoatlas build --help");
    }
    check_missing_of_both(arguments);
    if (is_atlas(arguments.file)) {
        throw Error(ErrorKind::usage,
                    {.file = arguments.file, .what = "is already a store", .expected = "a volume", .next = "name the volume file"});
    }
    const std::unique_ptr<VolumeReader> reader = open_input(arguments).reader;
    for (const std::string& note : arguments.inputs.assumed) terminal.say("note: " + note);
    if (arguments.dry_run) return dry_run(arguments, terminal, *reader, build_options(arguments, reader->info()));
    const BuildReport report = build_store(arguments, terminal, *reader);
    print_report(arguments, terminal, reader->info(), report);
    return 0;
}

}  // namespace isoatlas::cli
