// The page: inserts its data into the bundle of web/.
#include "isoatlas/page.h"

#include <algorithm>
#include <set>

#include "base/phase.h"
#include "catalogue/compare_smoothing.h"
#include "catalogue/joined_contents.h"
#include "catalogue/longest_tunnels.h"
#include "isoatlas/environment.h"
#include "page/page_file.h"
#include "page/page_json.h"

namespace isoatlas {
namespace {

PageReport report_of(const PageContents& contents) {
    PageReport report;
    std::set<std::int64_t> shown;
    for (const PageEntry& entry : contents.entries) {
        shown.insert(entry.branch);
        report.cavities += contents.branches[entry.branch].is_cavity;
        report.low += contents.branches[entry.branch].polarity == Polarity::low;
    }
    report.objects = static_cast<std::int64_t>(contents.entries.size());
    report.hidden =
        contents.objects + contents.cavities + (contents.low ? contents.low->objects : 0) - static_cast<std::int64_t>(shown.size());
    return report;
}

}  // namespace

PageReport write_page(const std::string& path, const Atlas& atlas, const PageOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    check_page_options(options);
    check_has_pages();
    const StoreSides sides{atlas, options.low};
    PageContents contents = sides.has_both()
                                ? joined_contents(sides, overview_of(atlas, context), overview_of(*sides.low, context), options, context)
                                : page_contents(atlas, overview_of(atlas, context), options, context);
    contents.notes = options.notes;
    contents.smoothing = options.smoothing;
    const std::string source = options.source.empty() ? atlas.info().path : options.source;
    const auto text_of = [&] {
        std::string json;
        JsonStream stream([&json](std::string_view text) { json += text; });
        write_page_json(stream, sides, contents, source);
        return json;
    };
    const auto drawn = [&](std::size_t pictures) {
        if (!options.partly_written) return;
        write_page_file(path, text_of());
        options.partly_written(static_cast<std::int64_t>(pictures));
    };
    contents.is_complete = false;
    const std::vector<CoarseSurface> surfaces = draw_pictures(contents, sides, options, drawn, context);
    contents.is_complete = true;
    report(context, only_phase("find the longest tunnels"), 0);  // after the pictures: of a CT it takes as long as they
    add_tunnels(contents, atlas, context);
    if (sides.has_both()) add_tunnels(contents, *sides.low, context);
    if (contents.smoothing) contents.comparison = compare_smoothing(atlas, contents.smoothing->sigma, options, context);
    const std::vector<PageMesh> meshes = page_meshes(surfaces, bytes_for_meshes(text_of(), std::ssize(surfaces)), context);
    for (std::size_t i = 0; i < meshes.size(); ++i) contents.entries[i].mesh = meshes[i];
    PageReport made = report_of(contents);
    made.bytes = write_page_file(path, text_of());
    return made;
}

}  // namespace isoatlas
