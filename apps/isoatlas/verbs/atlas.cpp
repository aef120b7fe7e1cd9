// isoatlas FILE: writes the page of the objects of a volume. Builds the store beside the page when there is none.
#include "data/object_directory.h"
#include "data/session.h"
#include "data/store_beside.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/progress.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {

int run_atlas(const Arguments& arguments, Terminal& terminal) {
    const std::string page = arguments.output.empty() ? stem_of(arguments.file) + ".atlas.html" : arguments.output;
    check_output(arguments, page, {".html"});
    const std::string store = store_for(arguments, terminal, store_beside(page));
    const Atlas atlas(store);
    PageReport report;
    {
        Session session(arguments, terminal);
        const WritingGuard guard;
        const std::int64_t top = arguments.top > 0 ? arguments.top : 24;
        const std::vector<ObjectName> names = names_in(object_names_path(store), atlas.info().extent, terminal);
        report = write_page(page, atlas, {.top = top, .top_cavities = (top + 1) / 2, .names = names, .source = store}, session.context());
    }
    if (arguments.json) {
        Json json = document("atlas", atlas.info(), atlas.interpolant(), atlas.tunnel_height());
        json["store"] = store;
        json["output"] = page;
        json["bytes"] = report.bytes;
        json["shown"] = report.objects;
        json["shown_cavities"] = report.cavities;
        json["hidden"] = report.hidden;
        print(terminal, json);
        return 0;
    }
    terminal.out() << page << ": " << counted(report.objects, "picture") << ", " << count_text(report.cavities) << " of cavities; "
                   << counted(report.hidden, "object") << " hidden; " << bytes_text(static_cast<double>(report.bytes)) << '\n';
    terminal.next("open " + page + " in a browser");
    return 0;
}

}  // namespace isoatlas::cli
