// isoatlas FILE: from a volume to the page that shows what is in it. Builds the store beside it when there is none.
#include <filesystem>

#include "document.h"
#include "interrupt.h"
#include "progress.h"
#include "session.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

/// scan.nii.gz, scan.nrrd and scan.atlas all give scan.
std::string stem_of(const std::string& file) {
    fs::path path(file);
    if (path.filename().empty()) path = path.parent_path();  // a folder
    std::string name = path.filename().string();
    for (const char* suffix : {".gz", ".nii", ".atlas"}) {
        if (name.ends_with(suffix)) name.resize(name.size() - std::string_view(suffix).size());
    }
    if (name == path.filename().string()) name = path.stem().string();
    return name;
}

/// scan.atlas.html and scan.html stand beside scan.atlas.
std::string store_beside(const std::string& page) {
    std::string store = page.substr(0, page.size() - std::string_view(".html").size());
    return store.ends_with(".atlas") ? store : store + ".atlas";
}

/// The store is of this file as it is now: newer than it.
bool is_fresh(const std::string& store, const std::string& file) {
    std::error_code error;
    return is_atlas(store) && !fs::is_directory(file, error) && fs::last_write_time(store, error) > fs::last_write_time(file, error) &&
           !error;
}

}  // namespace

int run_atlas(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.output.empty()) check_output(arguments, {".html"});
    const std::string page = arguments.output.empty() ? stem_of(arguments.file) + ".atlas.html" : arguments.output;
    std::string store = arguments.file;
    if (!is_atlas(arguments.file)) {
        store = store_beside(page);
        if (is_fresh(store, arguments.file) && !arguments.restart) {
            terminal.say("note: " + store + " is there already; --restart builds it anew");
        } else {
            Arguments build = arguments;
            build.output = store;
            build_store(build, terminal, *open_volume(arguments.file, arguments.open));
        }
    }
    const Atlas atlas(store);
    PageReport report;
    {
        Session session(arguments, terminal);
        const WritingGuard guard(page);
        const std::int64_t top = arguments.top > 0 ? arguments.top : 24;
        report = write_page(page, atlas, {.top = top, .top_dark = (top + 1) / 2, .source = store}, session.context());
    }
    if (arguments.json) {
        Json json = document("atlas", atlas.info(), atlas.interpolant(), atlas.tunnel_height());
        json["store"] = store;
        json["output"] = page;
        json["bytes"] = report.bytes;
        json["shown"] = report.objects;
        json["shown_dark"] = report.dark;
        json["hidden"] = report.hidden;
        print(terminal, json);
        return 0;
    }
    terminal.out() << page << ": " << counted(report.objects, "picture") << ", " << count_text(report.dark) << " of dark objects; "
                   << counted(report.hidden, "object") << " hidden; " << bytes_text(static_cast<double>(report.bytes)) << '\n';
    terminal.next("open " + page + " in a browser");
    return 0;
}

}  // namespace isoatlas::cli
