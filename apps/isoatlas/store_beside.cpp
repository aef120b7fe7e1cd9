#include "store_beside.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include "terminal.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kCompared = std::int64_t{1} << 30;  ///< bytes of samples: larger volumes are told by their headers and ages

bool is_newer(const std::string& store, const std::string& file) {
    std::error_code error;
    return !fs::is_directory(file, error) && fs::last_write_time(store, error) > fs::last_write_time(file, error) && !error;
}

bool is_of(const std::string& store, const Arguments& arguments) {
    const Atlas atlas(store);
    const VolumeInfo& info = atlas.info();
    if (arguments.gaussian) return std::abs(info.gaussian - *arguments.gaussian) <= 1e-6 * info.gaussian;
    const bool is_changed = info.gaussian > 0 || arguments.missing.action != MissingPolicy::Action::error;
    if (is_changed || info.extent.voxels() * size_of(info.type) > kCompared) return true;
    const std::unique_ptr<VolumeReader> volume = open_volume(arguments.file, arguments.open);
    const bool is_calibrated = volume->info().calibration.slope < 0;  // such samples are stored as they are reported
    return is_calibrated || atlas.is_of(*volume);
}

}  // namespace

bool is_fresh(const std::string& store, const Arguments& arguments) {
    return is_atlas(store) && is_newer(store, arguments.file) && is_of(store, arguments);
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

std::string store_beside(const std::string& page) {
    std::string store = page.substr(0, page.size() - std::string_view(".html").size());
    return store.ends_with(".atlas") ? store : store + ".atlas";
}

std::string store_for(const Arguments& arguments, Terminal& terminal, const std::string& store) {
    if (is_atlas(arguments.file)) return arguments.file;
    if (!arguments.restart && is_fresh(store, arguments)) {
        terminal.say("note: " + store + " is there already; --restart builds it anew");
        return store;
    }
    Arguments build = arguments;
    build.output = store;
    build_store(build, terminal, *open_volume(arguments.file, arguments.open));
    return store;
}

}  // namespace isoatlas::cli
