// isoatlas FILE: writes the page of the objects of a volume. Builds the store beside the page when there is none.
#include <fmt/format.h>

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

namespace {

/// What was corrected in the header, and assumed about the samples.
std::vector<std::string> notes_of(const Arguments& arguments, const Atlas& atlas) {
    std::vector<std::string> notes = atlas.info().notes;
    if (const Corrections corrections = corrections_of(arguments); !corrections.is_empty() && !is_atlas(arguments.file)) {
        OpenOptions plain = arguments.open;
        plain.spacing.reset(), plain.origin.reset(), plain.unit.reset(), plain.value_unit.reset();
        VolumeInfo info = open_volume(arguments.file, plain)->info();
        info.notes.clear();
        correct(info, corrections);
        notes = info.notes;
    }
    notes.insert(notes.end(), arguments.inputs.assumed.begin(), arguments.inputs.assumed.end());
    return notes;
}

/// Where the noise is strong: the command that makes the page of the filtered volume beside this one.
std::optional<PageSmoothing> smoothing_of(const Arguments& arguments, const VolumeInfo& info, const std::string& page) {
    const double sigma = advised_sigma(info, arguments.inputs.noise, arguments.inputs.range);
    if (sigma == 0) return std::nullopt;
    std::string name = page;
    for (const char* end : {".html", ".atlas"}) {
        if (name.ends_with(end)) name.resize(name.size() - std::string_view(end).size());
    }
    const std::string command = fmt::format("isoatlas {}{} --gaussian {} -o {}", shell_word(arguments.file), reading_options(arguments),
                                            sigma, shell_word(name + ".smooth.html"));
    return PageSmoothing{arguments.inputs.noise / arguments.inputs.range, sigma, command};
}

struct PrintedPage {
    std::string store, page;
    bool has_both;  ///< polarities
};

void print_page(const Arguments& arguments, Terminal& terminal, const Atlas& atlas, const PrintedPage& made, const PageReport& report) {
    if (arguments.json) {
        VolumeInfo info = atlas.info();
        info.notes = notes_of(arguments, atlas);
        Json json = document("atlas", info, atlas.interpolant(), atlas.tunnel_height());
        json["store"] = made.store;
        json["output"] = made.page;
        json["bytes"] = report.bytes;
        if (made.has_both) json["polarity"] = name_of(PolarityChoice::both);
        json["shown"] = report.objects;
        json["shown_low"] = report.low;
        json["shown_cavities"] = report.cavities;
        json["hidden"] = report.hidden;
        print(terminal, json);
        return;
    }
    const std::string others =
        made.has_both ? count_text(report.low) + " of objects of low values; " : count_text(report.cavities) + " of cavities; ";
    terminal.out() << made.page << ": " << counted(report.objects, "picture") << ", " << others << counted(report.hidden, "object")
                   << " hidden; " << bytes_text(static_cast<double>(report.bytes)) << '\n';
    terminal.next("open " + made.page + " in a browser");
}

}  // namespace

std::function<void(std::int64_t)> tell_first_pictures(Terminal& terminal, const std::string& page) {
    return [&terminal, page, is_first = true](std::int64_t pictures) mutable {
        if (is_first)
            terminal.say("note: " + page + " has its first " + counted(pictures, "picture") + "; open it now, and reload it for more");
        is_first = false;
    };
}

int run_atlas(const Arguments& arguments, Terminal& terminal) {
    if (arguments.inputs.are_labels) return run_label_page(arguments, terminal);
    const std::string page = arguments.output.empty() ? stem_of(arguments) + ".atlas.html" : arguments.output;
    check_output(arguments, page, {".html"});
    const std::function<void(std::int64_t)> tell = tell_first_pictures(terminal, page);
    PageDraft draft;
    const auto options_of = [&](const Atlas& atlas, const std::string& source) {
        const std::int64_t top = arguments.top > 0 ? arguments.top : 24;
        return PageOptions{
            .top = top,
            .top_cavities = (top + 1) / 2,
            .names = names_in(object_names_path(source, polarity_of(atlas.info())), atlas.info().extent, terminal),
            .source = source,
            .notes = notes_of(arguments, atlas),
            .smoothing = smoothing_of(arguments, atlas.info(), page),
            .partly_written = [&tell](std::int64_t pictures) { tell(pictures); },
            .draft = &draft,
        };
    };
    const auto write_first = [&](const std::string& high, const Context& context) {
        const Atlas atlas(high);
        write_first_page(page, atlas, options_of(atlas, store_beside(page)), draft, context);
    };
    const std::string store = store_for(arguments, terminal, store_beside(page), write_first);
    const bool is_volume = store != arguments.file;
    const Atlas atlas(store, {.polarity = arguments.side(), .corrections = is_volume ? Corrections{} : corrections_of(arguments)});
    std::optional<Atlas> low;  // of a store of both
    if (!arguments.side() && atlas.polarities() == PolarityChoice::both)
        low.emplace(store, AtlasOptions{.polarity = Polarity::low, .corrections = is_volume ? Corrections{} : corrections_of(arguments)});
    for (const std::string& note : arguments.inputs.assumed) terminal.say("note: " + note);
    PageReport report;
    {
        Session session(arguments, terminal);
        const WritingGuard guard;
        PageOptions options = options_of(atlas, store);
        if (low) {
            options.low = &*low;
            options.low_names = names_in(object_names_path(store, Polarity::low), atlas.info().extent, terminal);
        }
        report = write_page(page, atlas, options, session.context());
    }
    print_page(arguments, terminal, atlas, {store, page, low.has_value()}, report);
    return 0;
}

}  // namespace isoatlas::cli
