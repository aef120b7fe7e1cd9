#include "data/store_beside.h"

#include <filesystem>
#include <memory>

#include <isoatlas/dataset_path.h>

#include "data/input.h"
#include "data/session.h"
#include "data/source.h"
#include "options/suggest.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kCompared = std::int64_t{1} << 30;  ///< bytes of samples; for larger volumes the modification times are compared

bool is_newer(const std::string& store, const VolumeInfo& volume) {
    for (const std::string& file : {volume.path, volume.data_file}) {
        std::error_code error;
        if (file.empty() || !fs::exists(file, error)) continue;
        if (fs::last_write_time(store, error) <= fs::last_write_time(file, error) || error) return false;
    }
    return true;
}

/// Differences between a store and arguments.file.
std::string differences(const Atlas& atlas, const std::string& store, const Arguments& arguments) {
    const std::unique_ptr<VolumeReader> volume = open_input(arguments).reader;
    const VolumeInfo& info = volume->info();
    Context context;
    context.threads = arguments.threads;
    context.cancelled = interrupted;
    const bool is_small = info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type)) <= kCompared;
    std::vector<std::string> found = store_differences(atlas, *volume, build_options(arguments, info), is_small, context);
    if (found.empty() && !is_small && !is_newer(store, info)) found.emplace_back("the volume is newer than the store");
    return joined_differences(found);
}

[[noreturn]] void in_the_way(const std::string& store, const Arguments& arguments, const std::string& what) {
    const std::string build = "isoatlas build " + shell_word(arguments.file) + reading_options(arguments) + " -o OTHER.atlas";
    const std::string elsewhere =
        arguments.verb == "atlas" ? "-o writes page and store elsewhere" : build + " builds another store to view";
    throw Error(ErrorKind::usage, {.file = store, .what = what, .next = "--restart replaces it; " + elsewhere});
}

/// As part of the name of a file: letters, digits, "-" and "."; anything else becomes "_".
std::string file_word(const std::string& text) {
    constexpr std::size_t kMost = 80;
    std::string word = text.substr(0, kMost);
    for (char& c : word) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.';
        if (!is_plain) c = '_';
    }
    return word;
}

}  // namespace

Beside look_beside(const std::string& store, const Arguments& arguments) {
    Beside beside;
    std::error_code error;
    beside.is_there = fs::symlink_status(store, error).type() != fs::file_type::not_found;
    if (!beside.is_there || !is_atlas(store)) return beside;
    try {
        const Atlas atlas(store);
        beside.is_store = true;
        beside.is_replaceable = atlas.is_replaceable();
        beside.is_present = atlas.has_present_values();
        Arguments wanted = arguments;  // what somebody has built is shown as it is
        if (arguments.has_default_polarity && !beside.is_replaceable) wanted.polarity = atlas.polarities();
        beside.differs = differences(atlas, store, wanted);
        return beside;
    } catch (const Error& damaged) {
        if (damaged.kind() != ErrorKind::input || damaged.text().file != store) throw;
        ErrorText text = damaged.text();
        text.next = "it is damaged; --restart rebuilds it";
        throw Error(ErrorKind::input, text);
    }
}

bool is_usable(const std::string& store, const Arguments& arguments, Terminal& terminal) {
    const Beside beside = look_beside(store, arguments);
    if (!beside.is_there) return false;
    if (!beside.is_store) {
        check_output_file(store);
        in_the_way(store, arguments, "exists and is not an isoatlas store");
    }
    if (!beside.is_usable()) {
        if (!beside.is_replaceable)
            in_the_way(store, arguments, "is a store of other samples or options, and is not replaced: " + beside.differs);
        terminal.say("note: " + store + " is rebuilt: " + beside.differs);
        return false;
    }
    terminal.say("note: " + store + " exists and is used" + (arguments.read_only ? "" : "; --restart rebuilds it"));
    if (!beside.is_present)
        terminal.say("note: it was built by an earlier version of isoatlas: interpolated values may differ in their last digits");
    return true;
}

std::string stem_of(const std::string& file) {
    fs::path path(file);
    if (path.filename().empty()) path = path.parent_path();  // a folder
    std::string name = path.filename().string();
    for (const char* suffix : {".gz", ".nii", ".atlas"}) {
        if (name.ends_with(suffix)) name.resize(name.size() - std::string_view(suffix).size());
    }
    if (name == path.filename().string()) name = path.stem().string();
    return name;
}

std::string stem_of_volume(const Arguments& arguments) {
    const OpenOptions& open = arguments.open;
    const DatasetPath path = split_dataset(arguments.file);
    std::string stem = stem_of(path.file) + file_word(path.dataset);
    if (open.series) stem += "_" + file_word(*open.series);
    if (open.channel) stem += "_" + file_word(*open.channel);
    if (open.time_step) stem += "_t" + std::to_string(*open.time_step);
    if (open.level) stem += "_level" + std::to_string(*open.level);
    return stem;
}

std::string stem_of(const Arguments& arguments) {
    if (is_atlas(arguments.file)) return stem_of(arguments.file);
    return stem_of_volume(arguments) + (arguments.is_low() ? ".low" : "");
}

std::string store_beside(const std::string& page) {
    std::string store = page.substr(0, page.size() - std::string_view(".html").size());
    return store.ends_with(".atlas") ? store : store + ".atlas";
}

std::string store_for(const Arguments& arguments, Terminal& terminal, const std::string& store,
                      const std::function<void(const std::string&, const Context&)>& high_values) {
    if (is_atlas(arguments.file)) {
        check_store_options(arguments, Atlas(arguments.file, AtlasOptions{.polarity = arguments.side()}));
        return arguments.file;
    }
    if (!arguments.restart && is_usable(store, arguments, terminal)) return store;
    Arguments build = arguments;
    build.output = store;
    build_store(build, terminal, *open_input(arguments).reader, {}, high_values);
    return store;
}

}  // namespace isoatlas::cli
