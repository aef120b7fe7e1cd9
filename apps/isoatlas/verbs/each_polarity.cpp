// --polarity both of verbs about one polarity: they run once for high and once for low values.
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <isoatlas/output_file.h>

#include "data/sides.h"
#include "text/document.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array kPolarities{Polarity::high, Polarity::low};

/// "tree.csv": "tree-high.csv".
std::string file_of(const std::string& file, Polarity polarity) {
    if (file.empty()) return file;
    const fs::path path(file);
    return (path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), name_of(polarity), path.extension().string())).string();
}

/// quiet: the file is described already.
Arguments arguments_of(const Arguments& arguments, Polarity polarity) {
    Arguments own = of_side(arguments, polarity);
    own.output = file_of(arguments.output, polarity);
    own.curve = file_of(arguments.curve, polarity);
    if (polarity == Polarity::low) own.quiet = true, own.inputs.assumed.clear();
    return own;
}

/// Before the long work: the store holds both, and both files can be written.
void check_both_parts(const Arguments& arguments, Terminal& terminal) {
    Sides sides(arguments, terminal);
    for (const Polarity polarity : kPolarities) {
        if (!sides.holds(polarity)) static_cast<void>(sides.source(polarity));
        const Arguments own = arguments_of(arguments, polarity);
        if (!own.output.empty()) check_output_file(own.output);
        if (!own.curve.empty()) check_output_file(own.curve);
    }
}

int run_one(const Verb& verb, const Arguments& own, Terminal& terminal) {
    if (!own.json) terminal.out() << terminal.bold(fmt::format("{} values", name_of(*own.side()))) << "\n";
    return verb.run(own, terminal);
}

/// The files of high values alone would be half of the answer.
int run_second(const Verb& verb, const Arguments& arguments, Terminal& terminal) {
    try {
        return run_one(verb, arguments_of(arguments, Polarity::low), terminal);
    } catch (...) {
        const Arguments first = arguments_of(arguments, Polarity::high);
        std::error_code ignored;
        for (const std::string& file : {first.output, first.curve}) {
            if (!file.empty()) fs::remove(file, ignored);
        }
        throw;
    }
}

}  // namespace

bool runs_for_each_polarity(const Arguments& arguments) {
    constexpr std::array<std::string_view, 5> kOneTree{"tree", "spectrum", "handles", "table131", "compare"};
    if (arguments.polarity != PolarityChoice::both) return false;
    const bool is_one_list = !arguments.tau && !arguments.cavities && !arguments.both && arguments.curve.empty();
    if (arguments.verb == "objects") return !is_one_list;
    if (arguments.verb == "measure") return arguments.objects.empty();  // references say theirs
    return std::ranges::find(kOneTree, arguments.verb) != kOneTree.end();
}

int run_for_each_polarity(const Verb& verb, const Arguments& arguments, Terminal& terminal) {
    check_both_parts(arguments, terminal);
    int code = 0;  // a part is printed when there are both
    const std::string high = terminal.collected([&] { code = run_one(verb, arguments_of(arguments, Polarity::high), terminal); });
    const std::string low = terminal.collected([&] { code = std::max(code, run_second(verb, arguments, terminal)); });
    if (!arguments.json) {
        terminal.out() << high << '\n' << low;
        return code;
    }
    Json head = document("both");
    head["verb"] = verb.name;
    std::string text = head.dump();
    text.pop_back();  // open
    terminal.out() << text << ",\n\"high\": " << high << ",\"low\": " << low << "}\n";
    return code;
}

}  // namespace isoatlas::cli
