#include "selection_words.h"

#include "words.h"

namespace isoatlas::cli {
namespace {

/// A number of lines, or a part of all objects: a tree has no lines, tunnels are no objects.
void take_top(const std::string& word, Arguments& arguments) {
    const bool is_part = word.ends_with('%');
    if (!is_part && (arguments.verb == "tree" || arguments.verb == "label")) {
        throw Error(ErrorKind::usage,
                    {.what = "--top needs a percent sign here", .next = "--top 5% keeps a part of all objects, --keep N so many of them"});
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

void convert_selection(const std::function<bool(const char*)>& given, const TypedSelection& typed, Arguments& arguments) {
    Selection& selection = arguments.selection;
    if (!typed.top.empty()) take_top(typed.top, arguments);  // other verbs take numbers only, elsewhere
    if (given("--keep")) selection.keep = typed.keep;
    selection.least_voxels = typed.min_voxels;
    selection.least_measure = typed.min_volume;
    selection.least_hypervolume = typed.min_hypervolume;
    if (given("--persistence")) {
        arguments.persistence_in_percent = typed.persistence.ends_with('%');
        selection.least_persistence = parse_height("--persistence", typed.persistence);
    }
    for (const char* option : {"--keep", "--min-voxels", "--min-volume", "--min-hypervolume", "--persistence"})
        arguments.selects = arguments.selects || given(option);
}

}  // namespace isoatlas::cli
