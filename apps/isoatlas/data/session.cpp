#include "data/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <thread>

#include <unistd.h>

#include <fmt/format.h>

#include "data/input.h"
#include "options/suggest.h"
#include "text/interrupt.h"
#include "text/terminal.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string lower(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

void check_file_system(const std::string& output) {
    std::error_code ignored;
    if (fs::is_directory(output, ignored)) {
        if (lower_extension(output) == ".zarr" || lower_extension(output) == kPrecomputedExtension) {
            throw Error(
                ErrorKind::resource,
                {.file = output, .what = "is there already, and a folder is not replaced", .next = "remove it, or choose another name"});
        }
        throw Error(ErrorKind::usage, {.file = output, .what = "is a folder", .expected = "a file name", .next = "add a file name to it"});
    }
    fs::path folder = fs::path(output).parent_path();
    if (folder.empty()) folder = ".";
    if (!fs::is_directory(folder, ignored)) {
        throw Error(ErrorKind::resource,
                    {.file = output, .what = "the folder does not exist", .next = "mkdir -p " + shell_word(folder.string())});
    }
    check_output_file(output);
    if (ends_with(lower(output), ".raw")) check_output_file(output + ".json");  // its sidecar
}

}  // namespace

std::string lower_extension(const std::string& path) { return lower(fs::path(path).extension().string()); }

double machine_memory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGE_SIZE);
    return pages > 0 && page > 0 ? static_cast<double>(pages) * static_cast<double>(page) : INFINITY;
}

ValueRange range_of(const Volume& volume) {
    return visit_samples(volume, [](auto samples) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        return ValueRange{static_cast<double>(*low), static_cast<double>(*high)};
    });
}

Context Session::context() {
    Context context;
    context.threads = arguments_.threads;
    context.progress = [this](const Progress& progress) { progress_.update(progress); };
    context.cancelled = [] { return interrupted(); };
    return context;
}

std::string Session::describe(const VolumeInfo& info, const ValueRange& range) {
    const Scale scale(info);
    const Vec3& spacing = info.geometry.spacing;
    std::string line = fmt::format("{}  {}  {}  {}", shown_name(info.path), info.format, extent_text(info.extent), name_of(info.type));
    if (info.geometry.coordinates[0].empty()) {
        line += fmt::format("  spacing {:.5g} x {:.5g}", spacing[0], spacing[1]);
        if (info.extent.rank == 3) line += fmt::format(" x {:.5g}", spacing[2]);
        line += info.geometry.unit.empty() ? "" : " " + info.geometry.unit;
    }
    if (info.gaussian > 0) line += fmt::format("  Gaussian {:.5g}", info.gaussian);
    const auto [low, high] = scale.ends(range.low, range.high);
    line += fmt::format("  values {} .. {}{}", scale.brief(low), scale.brief(high), info.value_unit.empty() ? "" : " " + info.value_unit);
    return scale.is_low() ? line + "  objects of low values" : line;
}

Corrections corrections_of(const Arguments& arguments) {
    const OpenOptions& open = arguments.open;
    return {.spacing = open.spacing, .origin = open.origin, .unit = open.unit, .value_unit = open.value_unit};
}

Geometry voxel_geometry() {
    Geometry geometry;
    geometry.space = "voxel";
    return geometry;
}

Volume shaped(Volume volume, const std::optional<double>& gaussian, const std::optional<SampleBox>& box, const Context& context) {
    if (polarity_of(volume.info) == Polarity::low && gaussian)  // rounding is that of the file's samples
        return negated(shaped(negated(std::move(volume)), gaussian, box, context));
    if (box && gaussian) return gaussian_filter(volume, *box, *gaussian, context);
    if (gaussian) return gaussian_filter(volume, *gaussian, context);
    return box ? crop(volume, *box) : std::move(volume);
}

Volume Session::load() {
    Volume volume;
    std::optional<SampleBox> box;
    {
        Input input = open_input(arguments_);
        const std::unique_ptr<VolumeReader> reader = std::move(input.reader);
        box = input.box;
        const double min = cost_of_analysis(reader->info(), arguments_.threads).memory_smooth;
        if (min > machine_memory()) {
            terminal_.warn(
                fmt::format("{} needs {} or more, this machine has {}", arguments_.file, bytes_text(min), bytes_text(machine_memory())));
        }
        try {
            volume = load_volume(*reader, arguments_.missing, context());
        } catch (const std::bad_alloc&) {
            throw Error(ErrorKind::resource, {.file = arguments_.file,
                                              .what = "not enough memory to load the volume",
                                              .expected = cost_text(reader->info(), arguments_.threads),
                                              .next = "use a machine with more memory, or a smaller part of the volume"});
        }
    }
    stop_if_interrupted();
    std::ranges::copy(arguments_.inputs.assumed, std::back_inserter(volume.info.notes));
    for (const std::string& note : volume.info.notes) {
        if (!arguments_.quiet) terminal_.say("note: " + note);
    }
    if (arguments_.voxel_units) volume.info.geometry = voxel_geometry();
    volume = shaped(std::move(volume), arguments_.gaussian, box, context());
    if (arguments_.is_low()) volume = negated(std::move(volume));
    if (!arguments_.quiet) terminal_.say(describe(volume.info, range_of(volume)));
    return volume;
}

Cost cost_of_analysis(const VolumeInfo& info, int threads) {
    // Critical elements per voxel: smooth simulation data and white noise. Voxels per second on one processor for the same:
    // docs/performance.md.
    constexpr double few = 0.002, many = 0.95, fast = 25e6, slow = 1.5e6;
    const auto voxels = static_cast<double>(info.extent.voxels());
    const int available = std::max(1U, std::thread::hardware_concurrency());
    const double speed = std::min(threads > 0 ? threads : available, 8) * 0.8;
    const double input = voxels * (static_cast<double>(size_of(info.type)) + 12);
    return {input + 64 * few * voxels, input + 64 * many * voxels, voxels / fast / speed, voxels / slow / speed};
}

std::string cost_text(const VolumeInfo& info, int threads) {
    const Cost cost = cost_of_analysis(info, threads);
    const auto range = [](const std::string& low, const std::string& high) { return low == high ? low : low + " to " + high; };
    return fmt::format("memory {} (smooth to noisy data), time {}", range(bytes_text(cost.memory_smooth), bytes_text(cost.memory_noise)),
                       range(seconds_text(cost.seconds_smooth), seconds_text(cost.seconds_noise)));
}

void check_output(const Arguments& arguments, const std::vector<std::string>& extensions) {
    check_output(arguments, arguments.output, extensions);
}

void check_output(const Arguments& arguments, const std::string& output, const std::vector<std::string>& extensions) {
    const std::string name = lower(fs::path(output).filename().string());
    const bool known = std::any_of(extensions.begin(), extensions.end(),
                                   [&](const std::string& end) { return name.size() > end.size() && ends_with(name, end); });
    if (!known) {
        const std::string extension = fs::path(name).extension().string();
        const std::string near = nearest(extension, extensions);
        throw Error(ErrorKind::usage, {.file = output,
                                       .what = extension.empty() ? "the name has no extension" : "unknown extension " + extension,
                                       .expected = list_of(extensions),
                                       .next = near.empty() ? "the format follows the name" : "did you mean " + near + "?"});
    }
    check_file_system(output);
    std::error_code ignored;
    if (!arguments.file.empty() && fs::equivalent(output, arguments.file, ignored)) {
        throw Error(ErrorKind::usage,
                    {.file = output, .what = "the output would overwrite the input", .next = "choose another name with -o"});
    }
}

namespace {

std::string box_text(const SampleBox& box) {
    std::string text;
    for (std::size_t axis = 0; axis < 3; ++axis) text += fmt::format("{}{}:{}", axis > 0 ? "," : "", box.begin[axis], box.end[axis]);
    return text;
}

}  // namespace

std::string reading_options(const Arguments& arguments) {
    std::string text;
    if (arguments.open.dims) {
        text += " --dims ";
        for (std::size_t i = 0; i < arguments.open.dims->size(); ++i)
            text += fmt::format("{}{}", i > 0 ? "x" : "", (*arguments.open.dims)[i]);
    }
    if (arguments.open.type) text += fmt::format(" --type {}", name_of(*arguments.open.type));
    if (arguments.open.big_endian) text += *arguments.open.big_endian ? " --endian big" : " --endian little";
    if (arguments.open.skip_bytes) text += fmt::format(" --skip {}", *arguments.open.skip_bytes);
    const auto vector = [](const char* name, const Vec3& v) { return fmt::format(" {} {},{},{}", name, v[0], v[1], v[2]); };
    if (arguments.open.spacing) text += vector("--spacing", *arguments.open.spacing);
    if (arguments.open.origin) text += vector("--origin", *arguments.open.origin);
    if (arguments.open.time_step) text += fmt::format(" --time-step {}", *arguments.open.time_step);
    if (arguments.open.channel) text += " --channel " + shell_word(*arguments.open.channel);
    if (arguments.open.series) text += " --series " + shell_word(*arguments.open.series);
    if (arguments.open.level) text += fmt::format(" --level {}", *arguments.open.level);
    if (arguments.box) text += " --box " + box_text(*arguments.box);
    if (arguments.open.skip_rest) text += " --skip-rest";
    if (arguments.open.follow_links) text += " --follow-links";
    if (arguments.open.unit) text += " --unit " + (arguments.open.unit->empty() ? "none" : shell_word(ascii_unit(*arguments.open.unit)));
    if (arguments.open.value_unit) text += " --value-unit " + shell_word(*arguments.open.value_unit);
    const MissingPolicy::Action missing = arguments.missing.action;
    const bool is_beyond = missing == MissingPolicy::Action::below || missing == MissingPolicy::Action::above;
    if (is_beyond && !arguments.missing.no_data) text += " --missing below";
    if (arguments.missing.action == MissingPolicy::Action::replace) text += fmt::format(" --missing {}", arguments.missing.value);
    if (arguments.missing.no_data) text += fmt::format(" --no-data {}", *arguments.missing.no_data);
    if (!arguments.missing.no_data && !arguments.inputs.seeks_no_data) text += " --no-data none";
    if (arguments.inputs.labels != LabelChoice::automatic) text += arguments.inputs.are_labels ? " --labels yes" : " --labels no";
    if (arguments.gaussian) text += fmt::format(" --gaussian {}", *arguments.gaussian);
    if (arguments.voxel_units) text += " --voxel";
    if (arguments.interpolant == Interpolant::faces) text += " --interpolant faces";
    if (arguments.is_low()) text += " --polarity low";
    if (arguments.tunnel_height > 0)
        text += fmt::format(" --tunnel-height {}{}", arguments.tunnel_height, arguments.tunnel_height_in_percent ? "%" : "");
    return text;
}

}  // namespace isoatlas::cli
