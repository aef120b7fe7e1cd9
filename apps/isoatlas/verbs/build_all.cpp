// isoatlas build --all: a store for each channel and time step of a file, and an index of them.
#include <filesystem>

#include "data/assume_inputs.h"
#include "data/input.h"
#include "data/session.h"
#include "data/several.h"
#include "data/sides.h"
#include "data/store_beside.h"
#include "options/parse_errors.h"
#include "text/document.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

/// The folder of the stores; it exists afterwards.
void make_folder(const std::string& folder) {
    if (folder.ends_with(".atlas")) {
        throw Error(ErrorKind::usage, {.file = folder,
                                       .what = "--all writes a folder of stores",
                                       .expected = "a name of a folder",
                                       .next = "-o " + shell_word(folder.substr(0, folder.size() - 6) + ".atlases")});
    }
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (!failed && fs::is_directory(folder)) return;
    throw Error(ErrorKind::resource,
                {.file = folder, .what = failed ? failed.message() : "exists and is no folder", .next = "choose another name with -o"});
}

/// Is there a store that equals what would be built? Throws Error{usage} where there is another file.
bool is_built(const Arguments& own) {
    if (own.restart) return false;
    const Beside beside = look_beside(own.output, own);
    if (beside.is_usable()) return true;
    if (!beside.is_there) return false;
    throw Error(ErrorKind::usage, {.file = own.output,
                                   .what = beside.is_store ? "is a store of other samples or options: " + beside.differs
                                                           : "exists and is not an isoatlas store",
                                   .next = "--restart replaces the stores of this folder; -o writes into another one"});
}

struct BuiltStore {
    std::int64_t bytes = 0;
    bool was_there = false;
};

BuiltStore build_one(Arguments own, Terminal& terminal) {
    assume_inputs(own, terminal);
    own = with_sides(own);
    for (const std::string& note : own.inputs.assumed) terminal.say("note: " + note);
    const bool was_there = is_built(own);
    if (was_there)
        terminal.say("note: " + own.output + " exists and is kept; --restart rebuilds it");
    else
        (void)build_store(own, terminal, *open_input(own).reader);
    return {static_cast<std::int64_t>(fs::file_size(own.output)), was_there};
}

Json json_of(const Collection& collection, const std::vector<BuiltStore>& stores) {
    Json json = document("build-all");
    json["output"] = collection.folder;
    json["volume"] = collection.volume;
    json["channels"] = collection.channels.names;
    json["time_steps"] = {{"count", collection.channels.time_steps},
                          {"times", collection.channels.times},
                          {"unit", collection.channels.time_unit.empty() ? Json(nullptr) : Json(collection.channels.time_unit)}};
    json["stores"] = Json::array();
    for (std::size_t i = 0; i < stores.size(); ++i) {
        const auto volume = static_cast<std::int64_t>(i);
        json["stores"].push_back({{"channel", collection.channels.channel_of(volume)},
                                  {"time_step", collection.channels.time_step_of(volume)},
                                  {"file", collection.stores[i]},
                                  {"bytes", stores[i].bytes},
                                  {"was_there", stores[i].was_there}});
    }
    return json;
}

}  // namespace

bool builds_all(const Arguments& arguments) { return arguments.verb == "build" && arguments.all; }

int run_build_all(const Arguments& arguments, Terminal& terminal) {
    Several several;
    several.arguments = arguments;
    several.arguments.all = false;
    Arguments first = several.arguments;
    std::vector<std::string> notes;
    VolumeInfo info = open_first(first, notes)->info();
    several.channels = channels_of(info.volumes);
    if (arguments.open.channel || arguments.open.time_step)
        usage("--all builds every channel and time step", "omit --channel and --time-step, or --all");
    if (arguments.dry_run) {
        terminal.say("note: of the first of " + count_text(several.channels.count()) + " volumes");
        return run_build(of_volume(several, 0), terminal);
    }
    if (arguments.output.empty()) usage("`isoatlas build --all` needs --output FOLDER", "isoatlas build --help");
    make_folder(arguments.output);
    Collection collection{arguments.output, fs::path(info.path).filename().string(), several.channels, {}};
    std::vector<BuiltStore> built;
    for (std::int64_t volume = 0; volume < several.channels.count(); ++volume) {
        collection.stores.push_back(store_name(several.channels, volume));
        Arguments own = of_volume(several, volume);
        own.output = collection.path_of(volume);
        if (several.channels.count() > 1)
            terminal.say(volume_text(several.channels, volume) + ": store " + count_text(volume + 1) + " of " +
                         count_text(several.channels.count()));
        built.push_back(build_one(std::move(own), terminal));
    }
    write_collection(collection);
    if (arguments.json) {
        print(terminal, json_of(collection, built));
        return 0;
    }
    std::int64_t bytes = 0;
    for (const BuiltStore& store : built) bytes += store.bytes;
    terminal.out() << shown_name(arguments.output) << ": " << count_text(std::ssize(built)) << " stores, "
                   << bytes_text(static_cast<double>(bytes)) << ", and their index, collection.json\n";
    terminal.next("isoatlas view " + shell_word(arguments.output));
    return 0;
}

}  // namespace isoatlas::cli
