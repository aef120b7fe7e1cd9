// isoatlas name: names of objects and cavities, in a file beside the store.
#include <algorithm>

#include <fmt/format.h>

#include "data/object_directory.h"
#include "data/source.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

void check_arguments(const Arguments& arguments) {
    if (arguments.part.size() != 1 && arguments.part.size() <= 2) return;
    throw Error(ErrorKind::usage,
                {.what = arguments.part.size() == 1 ? "an object without its new name" : "more than an object and its name",
                 .expected = "an object and a name; quote a name with blanks",
                 .next = "isoatlas name " + shell_word(arguments.file) + " 2 skull"});
}

/// A named object in the table, or by its voxel where the table does not list it.
struct Line {
    ObjectName name;
    ChosenObject object;
};

std::vector<Line> lines_of(ObjectDirectory& directory, const std::vector<ObjectName>& names) {
    std::vector<Line> lines;
    for (const ObjectName& name : names) {
        const ObjectReference reference{.kind = ObjectReference::Kind::name, .tau = {}, .word = name.name};
        lines.push_back({name, directory.find({&reference, 1}).front()});
    }
    std::ranges::stable_sort(
        lines, {}, [](const Line& line) { return std::tuple(line.object.is_contour, line.object.number == 0, line.object.number); });
    return lines;
}

void print_json(const Arguments& arguments, Terminal& terminal, const Source& source, const std::vector<Line>& lines) {
    Json json = document("name", source.info());
    json["polarity"] = name_of(polarity_of(source.info()));
    json["file"] = names_file(arguments, polarity_of(source.info()));
    Json& list = json["names"] = Json::array();
    for (const auto& [name, object] : lines) {
        Json item{{"name", name.name}, {"reference", reference_of(object, true)}};
        item["number"] = object.number == 0 ? Json(nullptr) : Json(object.number);
        item["side"] = name.is_cavity ? "cavity" : "object";
        item["id"] = name.voxel;
        item["tau"] = name.isovalue;
        list.push_back(std::move(item));
    }
    print(terminal, json);
}

void print_text(Terminal& terminal, const std::vector<Line>& lines, const std::string& file) {
    if (lines.empty()) {
        terminal.say("there are no names");
        return;
    }
    Table table({{"object"}, {"name", true}, {"id"}, {"isovalue"}});
    for (const auto& [name, object] : lines) table.add({reference_of(object), name.name, voxel_word(name.voxel), object.tau_text});
    table.print(terminal);
    terminal.detail(file);
}

/// Takes names away and gives one.
void change(const Arguments& arguments, ObjectDirectory& directory, const Source& source, std::vector<ObjectName>& names) {
    const Scale scale(source.info());
    for (const ChosenObject& object : directory.find(arguments.removed_names)) {
        const auto removed = std::erase_if(names, [&](const ObjectName& name) {
            return name.is_cavity == object.is_contour && name.voxel == object.voxel && name.isovalue == scale.reported(object.tau);
        });
        if (removed > 0) continue;
        throw Error(ErrorKind::not_found, {.file = arguments.file,
                                           .what = title_of(object) + " has no name",
                                           .next = "isoatlas name " + shell_word(arguments.file) + " lists the names"});
    }
    if (arguments.part.empty()) return;
    const ObjectReference reference = parse_reference("the object", arguments.part[0]);
    const ChosenObject object = directory.find({&reference, 1}).front();
    set_object_name(names, {arguments.part[1], object.voxel, scale.reported(object.tau), object.is_contour});
}

}  // namespace

int run_name(const Arguments& arguments, Terminal& terminal) {
    check_arguments(arguments);
    if (arguments.part.size() == 2) check_object_name(arguments.part[1]);
    Source source(arguments, terminal);
    const std::string file = names_file(arguments, polarity_of(source.info()));
    std::vector<ObjectName> names = read_object_names(file, source.info().extent);
    ObjectDirectory directory(arguments, source, terminal);
    const std::vector<ObjectName> before = names;
    change(arguments, directory, source, names);
    if (names != before) {
        const WritingGuard guard;
        write_object_names(file, source.info().extent, names);
    }
    const std::vector<Line> lines = lines_of(directory, names);
    if (arguments.json) {
        print_json(arguments, terminal, source, lines);
    } else {
        print_text(terminal, lines, file);
    }
    return 0;
}

}  // namespace isoatlas::cli
