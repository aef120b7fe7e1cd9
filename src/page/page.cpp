// The page: inserts its data into the bundle of web/.
#include "isoatlas/page.h"

#include <algorithm>
#include <set>

#include "base/atomic_file.h"
#include "catalogue/joined_contents.h"
#include "catalogue/longest_tunnels.h"
#include "isoatlas/environment.h"
#include "page/page_json.h"
#include "page/template.h"

namespace isoatlas {
namespace {

/// JSON inside a script element: escapes everything that could end the element.
std::string escaped(const std::string& json) {
    std::string text;
    text.reserve(json.size());
    for (const char letter : json) text += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
    return text;
}

void check(const PageOptions& options) {
    const auto refuse = [](const char* what, const char* expected) { throw Error(ErrorKind::usage, {.what = what, .expected = expected}); };
    if (options.picture_size < 32 || options.picture_size > 1024) refuse("the size of the pictures is out of range", "32 to 1024");
    if (options.frames < 1 || options.frames > 64) refuse("the number of frames is out of range", "1 to 64");
    if (options.frames * options.picture_size > 16383) refuse("a turntable is too wide", "frames times size at most 16383");
    if (options.top < 1 || options.top_cavities < 0) refuse("the number of objects is out of range", "1 or more, of cavities 0 or more");
}

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
    check(options);
    if (page_template().empty()) {
        throw Error(ErrorKind::unsupported, {.what = "this isoatlas was built without pages",
                                             .next = "install npm and build it again with its pages",
                                             .reason = Reason::built_without_web});
    }
    const StoreSides sides{atlas, options.low};
    PageContents contents = sides.has_both()
                                ? joined_contents(sides, overview_of(atlas, context), overview_of(*sides.low, context), options, context)
                                : page_contents(atlas, overview_of(atlas, context), options, context);
    add_tunnels(contents, atlas, context);
    if (sides.has_both()) add_tunnels(contents, *sides.low, context);
    draw_pictures(contents, sides, options, context);
    contents.notes = options.notes;
    contents.smoothing = options.smoothing;
    std::string json;
    JsonStream stream([&json](std::string_view text) { json += text; });
    write_page_json(stream, sides, contents, options.source.empty() ? atlas.info().path : options.source);
    const std::string_view page = page_template(), mark = R"(<script id="atlas-data" type="application/json">null</script>)";
    const std::size_t at = page.find(mark), data = at + mark.find("null");
    AtomicFile file(path);
    file.write(page.substr(0, data));
    file.write(escaped(json));
    file.write(page.substr(data + 4));
    PageReport report = report_of(contents);
    report.bytes = file.size();
    file.commit();
    return report;
}

}  // namespace isoatlas
