#include "options/selection_words.h"

#include "options/options.h"
#include "options/words.h"

namespace isoatlas::cli {
namespace {

/// --top N limits lines, --top P% selects objects: `tree` has no lines, `handles` has no objects, `label` takes both.
void take_top(const std::string& word, Arguments& arguments) {
    const bool is_part = word.ends_with('%');
    const bool has_lines =
        arguments.verb == "objects" || arguments.verb == "measure" || arguments.verb == "handles" || arguments.verb == "label";
    if (!is_part && !has_lines) {
        throw Error(ErrorKind::usage, {.what = "--top requires a percent sign here",
                                       .next = "--top 5% keeps a part of all objects, --keep N keeps N objects"});
    }
    if (is_part && arguments.verb == "handles")
        throw Error(ErrorKind::usage, {.what = "--top takes a number here", .next = "--persistence 10% selects tunnels"});
    if (is_part) {
        arguments.selection.top_percent = parse_height("--top", word);
        arguments.selects = true;
    } else {
        arguments.top = parse_count("--top", word);
    }
}

}  // namespace

void add_selection(CLI::App& app, TypedSelection& typed, bool top) {
    const char* group = "Selection options";
    add_number(app, "--keep", typed.keep, "Keep the first N objects by hypervolume")
        ->check(in_range(std::int64_t{1}, std::int64_t{1} << 40))
        ->type_name("N")
        ->group(group);
    if (top) app.add_option("--top", typed.top, "Keep the first P percent of all objects")->type_name("P%")->group(group);
    add_number(app, "--min-voxels", typed.min_voxels, "Keep objects of at least N voxels just before they merge")
        ->check(in_range(0.0, 1e18))
        ->type_name("N")
        ->group(group);
    add_number(app, "--min-volume", typed.min_volume, "Keep objects of at least this volume in the file's unit (2D: area)")
        ->check(in_range(0.0, 1e300))
        ->type_name("V")
        ->group(group);
    app.add_option("--persistence", typed.persistence, "Keep objects of at least this persistence, or P percent of the range")
        ->type_name("H|P%")
        ->group(group);
    add_number(app, "--min-hypervolume", typed.min_hypervolume,
               "Keep objects of at least this hypervolume: sum of (value - value at which they merge)")
        ->check(in_range(0.0, 1e300))
        ->type_name("H")
        ->group(group);
}

void convert_selection(const std::function<bool(const char*)>& given, const TypedSelection& typed, Arguments& arguments) {
    Selection& selection = arguments.selection;
    if (!typed.top.empty()) take_top(typed.top, arguments);  // other verbs read a number directly
    if (given("--keep")) selection.keep = typed.keep;
    selection.min_voxels = typed.min_voxels;
    selection.min_measure = typed.min_volume;
    selection.min_hypervolume = typed.min_hypervolume;
    if (given("--persistence")) {
        arguments.persistence_in_percent = typed.persistence.ends_with('%');
        selection.min_persistence = parse_height("--persistence", typed.persistence);
    }
    for (const char* option : {"--keep", "--min-voxels", "--min-volume", "--min-hypervolume", "--persistence"})
        arguments.selects = arguments.selects || given(option);
}

}  // namespace isoatlas::cli
