#include "compare/methods.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "options/suggest.h"

namespace isoatlas::cli {
namespace {

template <class Info>
ComparedMethod described(const Info& info) {
    return {std::string(info.name), std::string(info.title), std::string(info.section), std::string(info.source), std::string(info.cost)};
}

ComparedSearch in_memory(const SearchMethodInfo& info) {
    return {described(info), [method = info.method](const Volume& volume, const std::string&, const Context& context) {
                return make_cell_search(method, volume, context);
            }};
}

/// blocks of so many KiB.
ComparedSearch interval_tree_file(std::int64_t kibibytes, bool is_usual) {
    const auto build = [kibibytes](const Volume& volume, const std::string& folder, const Context& context) {
        const std::string path = fmt::format("{}/cells-{}.tree", folder, kibibytes);
        write_interval_tree(path, volume, {.block_bytes = 1024 * kibibytes}, context);
        return std::make_unique<IntervalTreeFile>(path);
    };
    return {{.name = fmt::format("interval-tree-file-{}k", kibibytes),
             .title = fmt::format("I/O-optimal interval tree, blocks of {} KiB", kibibytes),
             .section = "3.8.6",
             .source = "Chiang, Silva, I/O optimal isosurface extraction, 1997",
             .cost = "log_B n + k / B, blocks of B cells",
             .is_usual = is_usual},
            build};
}

/// The time to build it has that of the trees and zones.
ComparedSearch zone_files(ZoneLayout layout, bool is_usual) {
    const bool is_by_path = layout == ZoneLayout::by_path;
    const std::string name = is_by_path ? "zone-files" : "zone-files-by-zone";
    const auto build = [layout, name](const Volume& volume, const std::string& folder, const Context& context) {
        const std::string path = fmt::format("{}/{}", folder, name);
        write_zone_files(path, volume, analyse(volume, {}, context), {.layout = layout}, context);
        return std::make_unique<ZoneFileSearch>(path);
    };
    return {{.name = name,
             .title = is_by_path ? "Zone files, a list for each heavy path" : "Zone files, a list for each zone component",
             .section = "10, 11",
             .source = "the dissertation",
             .cost = is_by_path ? "paths + k / B, blocks of B cells" : "zones + cells of the active zones / B",
             .is_usual = is_usual},
            build};
}

/// The product. The time to build the store has that of the trees.
ComparedSearch bricks() {
    const auto build = [](const Volume& volume, const std::string& folder, const Context& context) {
        const std::string path = folder + "/bricks.atlas";
        build_atlas(path, volume, {}, context);
        return std::make_unique<BrickSearch>(path);
    };
    return {{.name = "bricks", .title = "Bricks of a store", .source = "isoatlas", .cost = "n / 1024 + cells of the bricks divided"},
            build};
}

ComparedExtractor surface_method(const SurfaceMethodInfo& info) {
    return {described(info), [method = info.method](const Volume& volume) { return make_extractor(method, volume); },
            info.method == SurfaceMethod::trilinear};
}

ComparedExtractor dividing_cubes(int divisions, bool is_usual) {
    ComparedMethod method = described(info_of(SurfaceMethod::dividing_cubes));
    method.name += fmt::format("-{}", divisions);
    method.title += fmt::format(", {0} x {0} x {0}", divisions);
    method.is_usual = is_usual, method.divisions = divisions;
    return {method,
            [divisions](const Volume& volume) { return make_extractor(SurfaceMethod::dividing_cubes, volume, {.divisions = divisions}); }};
}

std::vector<std::string> words_of(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

template <class Method>
void keep(std::vector<Method>& methods, const std::vector<std::string>& words, const std::string& all_of_kind, const auto& is_reference) {
    const auto is_named = [&](const Method& method) {
        return std::ranges::any_of(words, [&](const std::string& word) {
            return word == method.name || ((word == all_of_kind || word == "all") && (method.is_usual || word == "all"));
        });
    };
    const bool has_any = std::ranges::any_of(methods, is_named);
    std::erase_if(methods, [&](const Method& method) { return !has_any || (!is_named(method) && !is_reference(method)); });
}

}  // namespace

ComparedMethods all_methods() {
    ComparedMethods all;
    for (const SurfaceMethodInfo& info : surface_methods()) {
        if (makes_points(info.method)) {
            for (const int divisions : {1, 2, 4}) all.extractors.push_back(dividing_cubes(divisions, divisions == 2));
        } else {
            all.extractors.push_back(surface_method(info));
        }
    }
    for (const SearchMethodInfo& info : search_methods()) all.searches.push_back(in_memory(info));
    all.searches.push_back(interval_tree_file(4, true));
    all.searches.push_back(interval_tree_file(64, false));
    all.searches.push_back(zone_files(ZoneLayout::by_path, true));
    all.searches.push_back(zone_files(ZoneLayout::by_zone, false));
    all.searches.push_back(bricks());
    return all;
}

ComparedMethods chosen_methods(const std::string& list) {
    ComparedMethods chosen = all_methods();
    std::vector<std::string> known{"surfaces", "searches", "all"};
    for (const ComparedMethod& method : chosen.extractors) known.push_back(method.name);
    for (const ComparedMethod& method : chosen.searches) known.push_back(method.name);
    const std::vector<std::string> words = list.empty() ? std::vector<std::string>{"surfaces", "searches"} : words_of(list);
    for (const std::string& word : words) {
        if (std::ranges::find(known, word) != known.end()) continue;
        const std::string near = nearest(word, known);
        throw Error(ErrorKind::usage, {.what = "there is no method " + shown_name(word),
                                       .expected = list_of(known),
                                       .next = near.empty() ? "isoatlas compare --help" : "did you mean " + near + "?"});
    }
    keep(chosen.extractors, words, "surfaces", [](const ComparedExtractor& method) { return method.is_reference; });
    keep(chosen.searches, words, "searches", [](const ComparedSearch& method) { return method.name == "brute-force"; });
    return chosen;
}

}  // namespace isoatlas::cli
