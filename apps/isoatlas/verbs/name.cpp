// isoatlas name: names of objects and cavities, in a file beside the store.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "data/sides.h"
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

using NamesOfSides = std::array<std::vector<ObjectName>, 2>;  ///< by polarity

std::vector<ObjectName>& of(NamesOfSides& names, Polarity polarity) { return names[static_cast<std::size_t>(polarity)]; }

/// Those of one side after those of the other one.
std::vector<Line> lines_of(Sides& sides, NamesOfSides& names) {
    std::vector<Line> lines;
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        for (const ObjectName& name : of(names, polarity)) {
            const ObjectReference reference{.kind = ObjectReference::Kind::name, .tau = {}, .word = name.name};
            lines.push_back({name, sides.directory(polarity).find({&reference, 1}).front()});
        }
    }
    std::ranges::stable_sort(lines, {}, [](const Line& line) {
        const ChosenObject& object = line.object;
        return std::tuple(object.polarity, object.is_contour, object.number == 0, object.number);
    });
    return lines;
}

void print_json(const Arguments& arguments, Terminal& terminal, Sides& sides, const std::vector<Line>& lines) {
    Json json = document("name", sides.main().info());
    json["polarity"] = name_of(sides.polarity());
    json["file"] = names_file(arguments, sides.polarity());
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
void change(const Arguments& arguments, Sides& sides, NamesOfSides& names) {
    const auto reported = [&](const ChosenObject& object) { return Scale(sides.source(object).info()).reported(object.tau); };
    for (const ChosenObject& object : sides.find(arguments.removed_names)) {
        const auto removed = std::erase_if(of(names, object.polarity), [&](const ObjectName& name) {
            return name.is_cavity == object.is_contour && name.voxel == object.voxel && name.isovalue == reported(object);
        });
        if (removed > 0) continue;
        throw Error(ErrorKind::not_found, {.file = arguments.file,
                                           .what = title_of(object) + " has no name",
                                           .next = "isoatlas name " + shell_word(arguments.file) + " lists the names"});
    }
    if (arguments.part.empty()) return;
    const ObjectReference reference = parse_reference("the object", arguments.part[0]);
    const ChosenObject object = sides.find({&reference, 1}).front();
    const Polarity other = object.polarity == Polarity::high ? Polarity::low : Polarity::high;
    if (find_object_name(of(names, other), arguments.part[1]) != nullptr) {
        throw Error(ErrorKind::usage, {.file = arguments.file,
                                       .what = "an object of " + std::string(name_of(other)) + " values has the name " + arguments.part[1],
                                       .next = "choose another name, or take it away: --remove " + shell_word(arguments.part[1])});
    }
    set_object_name(of(names, object.polarity), {arguments.part[1], object.voxel, reported(object), object.is_contour});
}

}  // namespace

int run_name(const Arguments& arguments, Terminal& terminal) {
    check_arguments(arguments);
    if (arguments.part.size() == 2) check_object_name(arguments.part[1]);
    Sides sides(arguments, terminal);
    const Extent extent = sides.main().info().extent;
    NamesOfSides names;
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        const bool is_asked = !arguments.side() || arguments.side() == polarity;
        if (is_asked && sides.holds(polarity)) of(names, polarity) = read_object_names(names_file(arguments, polarity), extent);
    }
    NamesOfSides before = names;
    change(arguments, sides, names);
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        if (of(names, polarity) == of(before, polarity)) continue;
        const WritingGuard guard;
        write_object_names(names_file(arguments, polarity), extent, of(names, polarity));
    }
    const std::vector<Line> lines = lines_of(sides, names);
    if (arguments.json) {
        print_json(arguments, terminal, sides, lines);
    } else {
        print_text(terminal, lines, names_file(arguments, sides.polarity()));
    }
    return 0;
}

}  // namespace isoatlas::cli
