// isoatlas levels: levels of detail of objects of a store, kept beside it.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "data/sides.h"
#include "text/document.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kUsual = 8;  ///< objects

std::vector<ChosenObject> prepared_objects(const Arguments& arguments, Sides& sides) {
    std::vector<ChosenObject> chosen = sides.find(arguments.objects);
    if (!arguments.objects.empty() && arguments.top == 0) return chosen;
    for (ChosenObject& object : sides.first(arguments.top > 0 ? arguments.top : kUsual)) chosen.push_back(std::move(object));
    if (chosen.empty()) sides.refuse_without_objects();
    return chosen;
}

/// What a file of levels has of one polarity.
struct File {
    std::string path;
    std::int64_t bytes = 0;
    Polarity polarity = Polarity::high;
    std::vector<PreparedLevels> surfaces{};
};

File make_file(const Arguments& arguments, Source& source, Polarity polarity, const std::vector<ChosenObject>& chosen) {
    std::vector<LevelsKey> keys;
    for (const ChosenObject& object : chosen) {
        if (object.polarity == polarity) keys.push_back({object.voxel, object.tau, object.is_contour});
    }
    File file{.path = arguments.output.empty() ? levels_path(arguments.file, polarity) : arguments.output, .polarity = polarity};
    if (keys.empty()) return file;
    file.surfaces = make_levels(source.atlas(), file.path, keys, {.memory = arguments.memory}, source.context());
    file.bytes = static_cast<std::int64_t>(std::filesystem::file_size(file.path));
    return file;
}

Json json_of(const File& file, const VolumeInfo& info) {
    Json json{{"file", file.path}, {"bytes", file.bytes}, {"polarity", name_of(file.polarity)}};
    Json& surfaces = json["surfaces"] = Json::array();
    for (const PreparedLevels& surface : file.surfaces) {
        surfaces.push_back({{"voxel", surface.key.voxel},
                            {"tau", info.calibration.reported(surface.key.tau)},
                            {"contour", surface.key.is_contour},
                            {"triangles", surface.triangles},
                            {"coarsest", surface.coarsest},
                            {"distance", surface.distance}});
    }
    return json;
}

void print_text(const File& file, Source& source, Terminal& terminal) {
    Table table({{"surface", true}, {"isovalue"}, {"triangles"}, {"coarsest"}, {"within, voxels"}});
    for (const PreparedLevels& surface : file.surfaces) {
        table.add({fmt::format("{}{}", surface.key.is_contour ? "contour " : "v", surface.key.voxel),
                   Scale(source.info()).text(surface.key.tau), count_text(surface.triangles), count_text(surface.coarsest),
                   fmt::format("{:.3g}", surface.distance)});
    }
    table.print(terminal);
    terminal.out() << fmt::format("{}: levels of {}, {}\n", shown_name(file.path),
                                  counted(static_cast<std::int64_t>(file.surfaces.size()), "surface"),
                                  bytes_text(static_cast<double>(file.bytes)));
}

}  // namespace

int run_levels(const Arguments& arguments, Terminal& terminal) {
    Sides sides(arguments, terminal);
    if (!sides.main().is_store()) {
        throw Error(ErrorKind::usage, {.file = arguments.file,
                                       .what = "levels of detail lie beside a store, and this is a volume file",
                                       .next = "isoatlas build " + shell_word(arguments.file) + " -o FILE.atlas, then its levels"});
    }
    const std::vector<ChosenObject> chosen = prepared_objects(arguments, sides);
    std::vector<File> files;
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        const bool is_asked = std::ranges::any_of(chosen, [&](const ChosenObject& object) { return object.polarity == polarity; });
        if (!is_asked) continue;
        if (!files.empty() && !arguments.output.empty()) {
            throw Error(ErrorKind::usage, {.what = "objects of high and of low values in one file",
                                           .next = "omit -o: each polarity has a file beside the store"});
        }
        files.push_back(make_file(arguments, sides.source(polarity), polarity, chosen));
    }
    if (arguments.json) {
        Json json = document("levels", sides.main().info(), sides.main().interpolant(), sides.main().tunnel_height(), Boundary::closed);
        Json& list = json["files"] = Json::array();
        for (const File& file : files) list.push_back(json_of(file, sides.source(file.polarity).info()));
        print(terminal, json);
        return 0;
    }
    for (const File& file : files) print_text(file, sides.source(file.polarity), terminal);
    terminal.next("isoatlas view " + shell_word(arguments.file) + ": coarse surfaces come first");
    return 0;
}

}  // namespace isoatlas::cli
