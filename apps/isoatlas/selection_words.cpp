#include "selection_words.h"

#include "words.h"

namespace isoatlas::cli {

void convert_selection(const std::function<bool(const char*)>& given, const TypedSelection& typed, Arguments& arguments) {
    Selection& selection = arguments.selection;
    if (given("--top") && !typed.top.ends_with('%')) {
        if (arguments.verb != "objects")
            throw Error(ErrorKind::usage, {.what = "--top needs a percent sign here",
                                           .next = "--top 5% keeps a part of all objects, --keep N so many of them"});
        arguments.top = parse_count("--top", typed.top);
    } else if (given("--top")) {
        selection.top_percent = parse_height("--top", typed.top);
        arguments.selects = true;
    }
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
