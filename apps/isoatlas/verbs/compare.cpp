// isoatlas compare: the methods of the literature on one volume, side by side: those that make surfaces, and those that search active
// cells.
#include <cmath>

#include <fmt/format.h>

#include "compare/output.h"
#include "data/source.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kPageIsovalues = 9, kPageSizes = 4;  ///< of the studies, unless the user says otherwise

std::int64_t half_of_memory() {
    const double memory = machine_memory();
    return std::isfinite(memory) ? static_cast<std::int64_t>(memory / 2) : 0;
}

bool makes_page(const Arguments& arguments) { return arguments.output.ends_with(".html"); }

CompareOptions compare_options_of(const Arguments& arguments) {
    const bool has_page = makes_page(arguments);
    return {.methods = chosen_methods(arguments.methods),
            .isovalues = arguments.samples.value_or(has_page ? kPageIsovalues : 0),
            .sizes = arguments.sizes.value_or(has_page ? kPageSizes : 0),
            .memory = arguments.memory > 0 ? arguments.memory : half_of_memory()};
}

std::string command_of(const Arguments& arguments) {
    std::string command =
        fmt::format("isoatlas compare {}{} --tau {}", shell_word(arguments.file), reading_options(arguments), *arguments.tau);
    if (!arguments.methods.empty()) command += " --methods " + shell_word(arguments.methods);
    return command + " -o " + shell_word(arguments.output);
}

/// Runs all, and draws where there is a page.
Comparison compare(const Arguments& arguments, Source& source, ComparePage& page) {
    const Volume& volume = source.volume();
    const double tau = source.tau();
    CompareOptions options = compare_options_of(arguments);
    if (volume.info.extent.rank < 3 || options.methods.extractors.empty())
        return run_comparison(volume, tau, options, {}, source.context());
    page.pictured = picture_box(volume, tau);
    if (!arguments.box) options.surface_part = page.pictured;  // of a box that somebody chose: all of it
    if (arguments.output.empty()) return run_comparison(volume, tau, options, {}, source.context());
    const Volume part = page.pictured ? crop(volume, *page.pictured) : Volume();
    const PictureUse use = makes_page(arguments) ? PictureUse::page : PictureUse::sheet;
    SurfacePictures pictures(page.pictured ? part : volume, tau, use, source.context());
    const LookAtSurface draw = [&pictures](const ExtractedSurface& one, const SurfaceInHand& made) { pictures.add(one, made); };
    const bool are_others = page.pictured && !options.surface_part;  // than those that are measured
    Comparison found = run_comparison(volume, tau, options, are_others ? LookAtSurface() : draw, source.context());
    if (are_others) static_cast<void>(run_extractors(part, tau, options.methods.extractors, draw, source.context()));
    pictures.add_ray_casting();
    page.pictures = pictures.pictures();
    if (makes_page(arguments) && pictures.camera() != nullptr)
        page.volume = make_volume_pictures(page.pictured ? part : volume, tau, *pictures.camera(), source.context());
    return found;
}

}  // namespace

int run_compare(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.tau) {
        throw Error(ErrorKind::usage,
                    {.what = "which isovalue?",
                     .expected = "--tau T",
                     .next = "isoatlas objects " + shell_word(arguments.file) + " lists the isovalues that show something"});
    }
    if (!arguments.output.empty()) check_output(arguments, {".html", ".webp", ".png"});
    if (!arguments.curve.empty()) check_output(arguments, arguments.curve, {".csv"});
    static_cast<void>(chosen_methods(arguments.methods));  // before the volume is read
    Source source(arguments, terminal);
    ComparePage page{.command = command_of(arguments)};
    const Comparison found = compare(arguments, source, page);
    stop_if_interrupted();
    {
        const WritingGuard guard;
        if (!arguments.curve.empty()) write_output(arguments.curve, csv_of(found));
        if (makes_page(arguments))
            write_output(arguments.output, html_of(found, page));
        else if (!arguments.output.empty())
            write_image(arguments.output, sheet_of(page.pictures));
    }
    if (arguments.json) {
        print(terminal, json_of(found, page.volume));
        return 0;
    }
    print_text(terminal, found);
    if (makes_page(arguments)) {
        terminal.next("open " + arguments.output + " in a browser");
    } else if (arguments.output.empty()) {
        terminal.next(fmt::format("isoatlas compare {}{} --tau {} -o compare.html    # pictures, and how times grow",
                                  shell_word(arguments.file), reading_options(arguments), *arguments.tau));
    }
    return 0;
}

}  // namespace isoatlas::cli
