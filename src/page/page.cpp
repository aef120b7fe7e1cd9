// The page: inserts its data into the bundle of web/.
#include "isoatlas/page.h"

#include <algorithm>
#include <optional>
#include <set>

#include "atlas/access.h"
#include "base/phase.h"
#include "catalogue/at_once.h"
#include "catalogue/compare_smoothing.h"
#include "catalogue/joined_contents.h"
#include "catalogue/longest_tunnels.h"
#include "catalogue/page_draft.h"
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

/// That of the draft, if there is one.
Overview overview_of_main(const Atlas& atlas, PageDraft* draft, const Context& context) {
    if (draft == nullptr || !draft->data().high) return overview_of(atlas, context);
    AtlasAccess::keep(atlas, std::move(draft->data().trees));
    Overview overview = std::move(*draft->data().high);
    draft->data().high.reset();
    return overview;
}

PageContents contents_of(const StoreSides& sides, const PageOptions& options, const Context& context) {
    const Overview overview = overview_of_main(sides.main, options.draft, context);
    PageContents contents = sides.has_both() ? joined_contents(sides, overview, overview_of(*sides.low, context), options, context)
                                             : page_contents(sides.main, overview, options, context);
    contents.notes = options.notes;
    contents.smoothing = options.smoothing;
    return contents;
}

/// What a page has beside its pictures. At the same time: tunnels are paired by one thread for most of the time, and of a CT that takes as
/// long as the pictures. Returns the coarse surfaces of the entries.
std::vector<CoarseSurface> after_pictures(PageContents& contents, const StoreSides& sides, const PageOptions& options,
                                          std::vector<std::optional<CoarseSurface>> made, const Context& context) {
    report(context, only_phase("find the longest tunnels"), 0);
    PageTunnels tunnels;
    std::optional<SmoothingComparison> comparison;
    std::vector<CoarseSurface> surfaces;
    const auto reduce = [&](const Context& own) { surfaces = coarse_surfaces(contents, sides, std::move(made), own); };
    const auto measure = [&](const Context& own) {
        tunnels = find_tunnels(contents, sides, own);
        if (contents.smoothing) comparison = compare_smoothing(sides.main, contents.smoothing->sigma, options, own);
    };
    at_once(context, measure, reduce);
    add_tunnels(contents, sides, tunnels);
    contents.comparison = std::move(comparison);
    return surfaces;
}

std::string text_of_page(const StoreSides& sides, const PageContents& contents, const PageOptions& options) {
    std::string json;
    JsonStream stream([&json](std::string_view text) { json += text; });
    write_page_json(stream, sides, contents, options.source.empty() ? sides.main.info().path : options.source);
    return json;
}

}  // namespace

PageDraft::PageDraft() : data_(std::make_unique<Data>()) {}
PageDraft::~PageDraft() = default;

void write_first_page(const std::string& path, const Atlas& atlas, const PageOptions& options, PageDraft& draft, const Context& context) {
    const EnvironmentScope scope(context);
    check_page_options(options);
    check_has_pages();
    if (atlas.info().extent.rank == 2) return;
    PageDraft::Data& kept = draft.data();
    kept.high = overview_of(atlas, context);
    kept.trees = AtlasAccess::trees(atlas);
    PageOptions objects = options;
    objects.top_cavities = 0;
    PageContents contents = page_contents(atlas, *kept.high, objects, context);
    contents.notes = options.notes, contents.smoothing = options.smoothing;
    contents.is_complete = false;
    draw_first_pictures(contents, atlas, options, kept, context);
    write_page_file(path, text_of_page({atlas}, contents, options));
    if (options.partly_written) options.partly_written(std::min(std::ssize(contents.entries), static_cast<std::ptrdiff_t>(kFirstCards)));
}

PageReport write_page(const std::string& path, const Atlas& atlas, const PageOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    check_page_options(options);
    check_has_pages();
    const StoreSides sides{atlas, options.low};
    PageContents contents = contents_of(sides, options, context);
    const auto text_of = [&] { return text_of_page(sides, contents, options); };
    const auto drawn = [&](std::size_t pictures) {
        if (!options.partly_written) return;
        write_page_file(path, text_of());
        options.partly_written(static_cast<std::int64_t>(pictures));
    };
    contents.is_complete = false;
    std::vector<std::optional<CoarseSurface>> coarse = draw_pictures(contents, sides, options, drawn, context);
    contents.is_complete = true;
    const std::vector<CoarseSurface> surfaces = after_pictures(contents, sides, options, std::move(coarse), context);
    const std::vector<PageMesh> meshes = page_meshes(surfaces, bytes_for_meshes(text_of(), std::ssize(surfaces)), context);
    for (std::size_t i = 0; i < meshes.size(); ++i) contents.entries[i].mesh = meshes[i];
    PageReport made = report_of(contents);
    made.bytes = write_page_file(path, text_of());
    return made;
}

}  // namespace isoatlas
