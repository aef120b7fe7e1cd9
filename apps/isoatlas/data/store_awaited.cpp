#include "data/store_awaited.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include "data/input.h"
#include "data/session.h"
#include "data/source.h"
#include "data/store_beside.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{300};  ///< polling interval of another process
constexpr std::chrono::milliseconds kTellEvery{50};

fs::file_time_type age_of(const std::string& path) {
    std::error_code error;
    return fs::last_write_time(path, error);
}

[[noreturn]] void no_store(const Arguments& arguments, const std::string& store, const std::string& what) {
    const bool is_volume = arguments.file != store;
    const std::string volume = is_volume ? shell_word(arguments.file) : "VOLUME";
    throw Error(ErrorKind::resource, {.file = arguments.file,
                                      .what = what,
                                      .next = "isoatlas build " + volume + reading_options(arguments) + " -o " + shell_word(store)});
}

/// Waits while another process builds the store. Returns whether there is a new one.
bool await_others(const std::string& store, const std::function<void(const BuildState&)>& tell) {
    const fs::file_time_type before = age_of(store);
    bool waited = false;
    while (const std::optional<BuildState> state = build_state(store)) {
        stop_if_interrupted();
        tell(*state);
        std::this_thread::sleep_for(kLook);
        waited = true;
    }
    return waited && is_atlas(store) && age_of(store) != before;
}

void build(const Arguments& arguments, Terminal& terminal, const std::string& store, const std::function<void(const BuildState&)>& tell) {
    Arguments build = arguments;
    build.output = store;
    BuildClock clock;
    Clock::time_point told;
    build_store(build, terminal, *open_input(arguments).reader, [&](const Progress& progress) {
        const BuildState state = clock.at(progress);
        if (Clock::now() - told < kTellEvery) return;
        told = Clock::now();
        tell(state);
    });
}

}  // namespace

std::string store_to_view(const Arguments& arguments) {
    return is_atlas(arguments.file) || arguments.file.ends_with(".atlas") ? arguments.file : stem_of(arguments) + ".atlas";
}

void check_is_volume(const Arguments& arguments, const VolumeInfo& info) {
    if (info.extent.rank == 3) return;
    throw Error(ErrorKind::usage, {.file = arguments.file,
                                   .what = "an image has no surfaces to explore",
                                   .expected = "a volume",
                                   .next = "isoatlas " + shell_word(arguments.file) + reading_options(arguments) + " makes a page of it"});
}

bool is_ready(const Arguments& arguments, Terminal& terminal, const std::string& store) {
    if (is_atlas(arguments.file)) {
        check_store_options(arguments, Atlas(arguments.file, AtlasOptions{.polarity = arguments.side()}));
        return true;
    }
    if (arguments.read_only || build_state(store)) {  // not replaced here
        const Beside beside = look_beside(store, arguments);
        if (!arguments.restart && beside.is_usable()) return is_usable(store, arguments, terminal);
        if (build_state(store)) return false;
        const std::string why = beside.differs.empty() ? "" : " with these options (" + beside.differs + ")";
        no_store(arguments, store, "it has no store" + why + ", and --read-only does not write one");
    }
    if (!arguments.restart && is_usable(store, arguments, terminal)) return true;
    check_is_volume(arguments, open_input(arguments).reader->info());
    return false;
}

void await_store(const Arguments& arguments, Terminal& terminal, const std::string& store,
                 const std::function<void(const BuildState&)>& tell) {
    const auto is_right = [&] { return arguments.file == store || is_usable(store, arguments, terminal); };
    while (!await_others(store, tell) || !is_right()) {
        if (arguments.read_only || arguments.file == store)
            no_store(arguments, store, "the build by another process ended without a store of it");
        try {
            return build(arguments, terminal, store, tell);
        } catch (const Error&) {
            if (!build_state(store)) throw;  // else another process has started a build
        }
    }
}

}  // namespace isoatlas::cli
