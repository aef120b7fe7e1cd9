// One CLI11 parser for each verb.
#include "options/arguments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>
#include <isoatlas/version.h>
#include <CLI/CLI.hpp>

#include "options/parse_errors.h"
#include "options/verb_options.h"
#include "options/words.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

bool reads_volumes(const std::string& verb) {
    return verb != "phantom" && verb != "completion" && verb != "manual" && verb != "dump" && verb != "ask" && verb != "serve";
}

std::unique_ptr<CLI::App> make_parser(const Verb& verb, Arguments& arguments, Typed& typed) {
    auto app = std::make_unique<CLI::App>(verb.summary, "isoatlas " + verb.name);
    CLI::Option* operand = app->add_option(verb.operand, arguments.file,
                                           reads_volumes(verb.name) ? "The file (or folder of slices)"
                                           : verb.name == "dump"    ? "The store"
                                           : verb.name == "serve"   ? "The folder"
                                           : verb.name == "ask"     ? "Address that `isoatlas view` printed"
                                                                    : "");
    operand->type_name("");
    if (verb.name != "phantom" && verb.name != "manual") operand->required();
    if (verb.name == "dump") app->add_option("PART", arguments.part, "Part to print; default: a list of all parts")->type_name("");
    if (verb.name == "name")
        app->add_option("OBJECT", arguments.part, "An object (2, c3, low2, v81275@150), then its name; nothing: list the names")
            ->type_name("");
    if (verb.name == "ask")
        app->add_option("REQUEST", arguments.part, "Path, such as '/api/objects?tau=300' (docs/server.md)")->type_name("");
    add_options_of(verb.name, *app, arguments, typed);
    if (reads_volumes(verb.name)) add_reading(*app, arguments, typed);
    if (reads_volumes(verb.name) && verb.name != "info" && verb.name != "convert") {
        add_interpolant(*app, typed);
        add_polarity(*app, typed);
    }
    add_talking(*app, arguments);
    app->get_formatter()->column_width(34);
    std::string examples = "Examples:\n";
    for (const std::string& example : verb.examples) examples += "  " + example + "\n";
    app->footer(examples + verb.terms + "\nExit codes: isoatlas --help. More: docs/cli.md");
    return app;
}

void convert_gaussian(const std::string& word, Arguments& arguments) {
    arguments.inputs.seeks_gaussian = word == "auto";
    if (arguments.inputs.seeks_gaussian) return;
    const auto sigma = parse_number<double>("--gaussian", word);
    if (!std::isfinite(sigma) || sigma <= 0)
        usage("--gaussian is not above 0", "give the standard deviation in the unit of the spacing that `isoatlas info` prints, or auto");
    arguments.gaussian = sigma;
}

/// A no-data value that the user names is missing: without --missing, it lies below all others (convert_polarity(): or above them).
void convert_no_data(const std::string& word, Arguments& arguments) {
    arguments.inputs.seeks_no_data = word == "auto";
    if (word == "auto" || word == "none") return;
    arguments.missing.no_data = parse_number<double>("--no-data", word);
    if (arguments.missing.action == MissingPolicy::Action::error) arguments.missing.action = MissingPolicy::Action::below;
}

void convert_polarity(const std::string& word, Arguments& arguments) {
    const std::vector<std::pair<std::string, PolarityChoice>> choices{
        {"high", PolarityChoice::high}, {"low", PolarityChoice::low}, {"both", PolarityChoice::both}};
    arguments.polarity = parse_choice<PolarityChoice>("--polarity", word, choices);
    MissingPolicy::Action& missing = arguments.missing.action;
    if (missing == MissingPolicy::Action::below && arguments.is_low()) missing = MissingPolicy::Action::above;  // in no object
}

/// An isovalue parts high from low values: what is made of everything on one side of it is of one polarity.
void check_both(const Arguments& arguments) {
    constexpr std::array<std::string_view, 4> kChooseObjects{"extract", "label", "render", "animate"};
    if (arguments.polarity != PolarityChoice::both) return;
    if (arguments.verb == "handles" && !arguments.objects.empty())
        usage("--polarity both with --object", "omit --polarity: a reference says its polarity (2, low2)");
    if (std::ranges::find(kChooseObjects, arguments.verb) == kChooseObjects.end()) return;
    const AnimationArguments& animation = arguments.picture.animation;
    const bool has_isovalue = arguments.tau || !arguments.picture.taus.empty() || arguments.zones || !arguments.contours.empty() ||
                              animation.from || animation.to;
    const bool chooses =
        arguments.top > 0 || arguments.best || !arguments.objects.empty() || arguments.verb == "render" || arguments.verb == "animate";
    if (!has_isovalue && chooses) return;
    usage("--polarity both is about the list of objects of both polarities", "choose --polarity high or --polarity low, or omit it",
          "--top N or --object REF");
}

/// A store is filtered slab by slab while it is built, and would not know the samples around a box.
void check_box(const Arguments& arguments) {
    const bool builds = arguments.verb == "atlas" || arguments.verb == "view" || arguments.verb == "build";
    const bool filters = arguments.gaussian || arguments.inputs.seeks_gaussian;
    if (!builds || !arguments.box || !filters) return;
    usage("--box with --gaussian cannot be built into a store",
          "isoatlas convert VOLUME --box ... --gaussian ... -o PART.nrrd writes the filtered box; then give PART.nrrd");
}

/// Of `animate`: the first option that is neither about isovalues nor one of all verbs.
std::string first_picture_option(const CLI::App& app) {
    constexpr std::array<std::string_view, 5> kOthers{"from", "to", "steps", "output", "help"};
    for (const CLI::Option* option : app.get_options()) {
        const std::string group = option->get_group();
        if (option->count() == 0 || option->get_lnames().empty() || group == "Input options" || group == "Output options") continue;
        const std::string& name = option->get_lnames()[0];
        if (std::ranges::find(kOthers, name) == kOthers.end()) return "--" + name;
    }
    return {};
}

/// How a RAW file is read, and which volume of a file of several. given(option): was it typed?
template <class Given>
void convert_reading(const Given& given, const Typed& typed, Arguments& arguments) {
    if (given("--dims")) arguments.open.dims = parse_dims(typed.dims);
    if (given("--type")) arguments.open.type = parse_type(typed.type);
    if (given("--endian")) arguments.open.big_endian = parse_choice<bool>("--endian", typed.endian, {{"little", false}, {"big", true}});
    if (given("--skip")) arguments.open.skip_bytes = typed.skip;
    if (given("--spacing")) arguments.open.spacing = parse_vector("--spacing", typed.spacing, 1);
    if (given("--origin")) arguments.open.origin = parse_vector("--origin", typed.origin, 0);
    if (given("--cache")) arguments.cache = parse_bytes("--cache", typed.cache, 0);
    if (given("--channel")) arguments.open.channel = typed.channel;
    if (given("--series")) arguments.open.series = typed.series;
    if (given("--level")) arguments.open.level = typed.level;
    if (given("--time-step")) arguments.open.time_step = typed.time_step;
}

void convert(const CLI::App& app, const Typed& typed, Arguments& arguments) {
    const auto given = [&](const char* name) {
        const CLI::Option* option = app.get_option_no_throw(name);
        return option != nullptr && option->count() > 0;
    };
    convert_reading(given, typed, arguments);
    if (given("--against")) {
        arguments.mesh = arguments.file;
        arguments.file = typed.against;
    }
    if (given("--box")) arguments.box = parse_box("--box", typed.box);
    if (given("--unit")) arguments.open.unit = parse_unit("--unit", typed.unit);
    if (given("--value-unit")) arguments.open.value_unit = parse_unit("--value-unit", typed.value_unit);
    if (given("--gaussian")) convert_gaussian(typed.gaussian, arguments);
    arguments.objects = parse_references("--object", typed.objects);
    arguments.contours = parse_references("--contour", typed.contours);
    arguments.removed_names = parse_references("--remove", typed.removed_names);
    if (given("--missing")) arguments.missing = parse_missing(typed.missing);
    if (given("--no-data")) convert_no_data(typed.no_data, arguments);
    if (given("--polarity")) convert_polarity(typed.polarity, arguments);
    arguments.inputs.labels = parse_choice<LabelChoice>(
        "--labels", typed.labels, {{"auto", LabelChoice::automatic}, {"yes", LabelChoice::yes}, {"no", LabelChoice::no}});
    convert_selection(given, typed.selection, arguments);
    if (app.get_option_no_throw("--background") != nullptr) convert_picture(typed.picture, arguments.picture);
    if (arguments.verb == "animate") arguments.picture.animation.picture_option = first_picture_option(app);
    if (given("--tau") && typed.picture.taus.empty()) {
        if (!std::isfinite(typed.tau))
            usage("--tau is not a finite number", "give an isovalue inside the range that `isoatlas info` prints");
        arguments.tau = typed.tau;
    }
    arguments.interpolant = parse_choice<Interpolant>("--interpolant", typed.interpolant,
                                                      {{"faces", Interpolant::faces}, {"trilinear", Interpolant::trilinear}});
    arguments.interpolant_given = given("--interpolant");
    if (given("--tunnel-height")) {
        arguments.tunnel_height_in_percent = typed.tunnel_height.ends_with('%');
        arguments.tunnel_height = parse_height("--tunnel-height", typed.tunnel_height);
        if (arguments.interpolant != Interpolant::trilinear)
            usage("--tunnel-height does not apply to --interpolant faces", "omit --interpolant faces: trilinear is the default");
    }
    if (given("--memory")) arguments.memory = parse_bytes("--memory", typed.memory);
    arguments.shell = parse_choice<ShellChoice>("--shell", typed.shell,
                                                {{"all", ShellChoice::all}, {"outer", ShellChoice::outer}, {"inner", ShellChoice::inner}});
    arguments.style =
        parse_choice<SurfaceStyle>("--style", typed.style, {{"compact", SurfaceStyle::compact}, {"full", SurfaceStyle::full}});
    arguments.boundary = parse_choice<Boundary>("--boundary", typed.boundary, {{"closed", Boundary::closed}, {"open", Boundary::open}});
    if (given("--space")) {
        arguments.space = parse_choice<PointSpace>("--space", typed.space,
                                                   {{"lps", PointSpace::lps}, {"ras", PointSpace::ras}, {"file", PointSpace::volume}});
    }
    arguments.detail = parse_choice<TreeDetail>("--detail", typed.detail,
                                                {{"events", TreeDetail::events},
                                                 {"levels", TreeDetail::levels},
                                                 {"elements", TreeDetail::elements},
                                                 {"contours", TreeDetail::contours}});
    check_both(arguments);
    check_box(arguments);
}

/// Moves options before the verb behind it, so that `isoatlas --json info FILE` works. Returns the verb, "" if there is none.
std::string take_verb(std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--threads") {
            ++i;
        } else if (words[i].empty()) {
            usage("the verb or file is an empty word", "isoatlas --help");
        } else if (words[i][0] != '-' || words[i] == "-") {
            const std::string verb = words[i];
            std::vector<std::string> before(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i));
            words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            words.insert(words.end(), before.begin(), before.end());
            return verb;
        }
    }
    return "";
}

bool is_version(const std::string& word) { return word == "--version" || word == "-V"; }

Parsed parse_without_verb(const std::vector<std::string>& words) {
    Parsed parsed;
    if (words.empty()) parsed.text = greeting();
    for (const std::string& word : words) {
        if (word == "-h" || word == "--help") parsed.text = overview();
        if (is_version(word) && parsed.text.empty()) parsed.text = "isoatlas " ISOATLAS_VERSION "\n";
    }
    if (parsed.text.empty()) usage("no verb after " + words[0], "isoatlas --help");
    return parsed;
}

Parsed parse_help(const std::vector<std::string>& words) {
    Parsed parsed;
    if (words.empty() || words[0][0] == '-') {
        parsed.text = overview();
        return parsed;
    }
    const Verb* verb = find_verb(words[0]);
    if (verb == nullptr) unknown_verb(words[0]);
    Arguments arguments;
    Typed typed;
    parsed.text = make_parser(*verb, arguments, typed)->help();
    return parsed;
}

}  // namespace

Parsed parse(const std::vector<std::string>& given) {
    std::vector<std::string> words = join_numbers(given);
    std::string name = take_verb(words);
    std::error_code ignored;
    const bool is_verb = find_verb(name) != nullptr || name == "help" || name.empty();
    if (!is_verb && (is_path(name) || std::filesystem::exists(name, ignored))) {  // isoatlas FILE
        words.insert(words.begin(), name);
        name = "atlas";
    }
    if (name.empty()) return parse_without_verb(words);
    if (name == "help") return parse_help(words);
    const Verb* verb = find_verb(name);
    if (verb == nullptr) unknown_verb(name);

    Parsed parsed;
    Typed typed;
    parsed.arguments.verb = name;
    const auto parser = make_parser(*verb, parsed.arguments, typed);
    if (std::ranges::any_of(words, is_version)) return parse_without_verb({"--version"});
    refuse_empty_values(*parser, words);
    try {
        std::vector<std::string> reversed(words.rbegin(), words.rend());  // CLI11 takes words from the back
        parser->parse(std::move(reversed));
    } catch (const CLI::CallForHelp&) {
        parsed.text = parser->help();
        return parsed;
    } catch (const CLI::ParseError& error) {
        explain(*parser, name, words, error);
    }
    convert(*parser, typed, parsed.arguments);
    return parsed;
}

std::vector<DescribedOption> described_options(const std::string& verb) {
    Arguments arguments;
    Typed typed;
    const Verb* found = find_verb(verb);
    std::vector<DescribedOption> options;
    if (found == nullptr) return options;
    const auto parser = make_parser(*found, arguments, typed);
    for (const CLI::Option* option : parser->get_options()) {
        if (option->get_lnames().empty()) continue;  // the operand
        const bool has_value = option->get_items_expected_max() > 0;
        options.push_back({.short_names = option->get_snames(),
                           .long_names = option->get_lnames(),
                           .value = has_value ? option->get_type_name() : "",
                           .group = option->get_group(),
                           .meaning = option->get_description(),
                           .is_required = option->get_required()});
    }
    return options;
}

}  // namespace isoatlas::cli
