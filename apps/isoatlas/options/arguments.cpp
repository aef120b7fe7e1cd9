// One CLI11 parser for each verb.
#include "options/arguments.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <isoatlas/version.h>
#include <CLI/CLI.hpp>

#include "options/options.h"
#include "options/suggest.h"
#include "options/words.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

[[noreturn]] void usage(const std::string& what, const std::string& next, const std::string& expected = {}) {
    throw Error(ErrorKind::usage, {.what = what, .expected = expected, .next = next});
}

/// Options as typed; converted after parsing, so that all messages have one form.
struct Typed {
    std::string box, dims, type, endian, spacing, origin, missing, interpolant = "trilinear", tunnel_height, shell = "all",
                                                                   style = "compact", boundary = "closed", detail = "events", memory;
    TypedSelection selection;
    double no_data = 0;
    double tau = 0, gaussian = 0;
    std::int64_t skip = 0, time_step = 0;
    PictureWords picture;
};

void add_talking(CLI::App& app, Arguments& arguments) {
    app.add_flag("--json", arguments.json, "One JSON document on standard output, errors included")->group("Output options");
    app.add_flag("-q,--quiet", arguments.quiet, "No progress, no hints")->group("Output options");
    app.add_flag("-v,--verbose", arguments.verbose, "Print time and memory")->group("Output options");
    app.add_flag("--no-color", arguments.no_color, "No colours (also: NO_COLOR in the environment)")->group("Output options");
    add_number(app, "--threads", arguments.threads, "Number of threads; 0: one per processor. Results do not depend on it")
        ->check(in_range(0, 4096))
        ->type_name("N")
        ->group("Output options");
}

void add_reading(CLI::App& app, Arguments& arguments, Typed& typed) {
    const char* group = "Input options";
    app.add_option("--dims", typed.dims, "Samples per axis of a RAW file, x fastest: 512x512x100")->type_name("NX[xNY[xNZ]]")->group(group);
    app.add_option("--type", typed.type, "Sample type of a RAW file: uint8 int8 uint16 int16 uint32 int32 float32 float64")
        ->type_name("T")
        ->group(group);
    app.add_option("--endian", typed.endian, "Byte order of a RAW file: little or big")->type_name("E")->group(group);
    add_number(app, "--skip", typed.skip, "Bytes before the samples of a RAW file")->type_name("BYTES")->group(group);
    app.add_option("--spacing", typed.spacing, "Spacing of the samples per axis: 0.7,0.7,1.5")->type_name("X,Y[,Z]")->group(group);
    app.add_option("--origin", typed.origin, "Position of the first sample")->type_name("X,Y[,Z]")->group(group);
    add_number(app, "--time-step", typed.time_step, "Volume of a 4D file, from 0")->type_name("N")->group(group);
    app.add_flag("--skip-rest", arguments.open.skip_rest, "Ignore bytes after the samples; without it they are an error")->group(group);
    app.add_flag("--follow-links", arguments.open.follow_links, "Follow headers and links to files outside their folder")->group(group);
    app.add_option("--missing", typed.missing, "Replace NaN and infinite samples by VALUE; below: less than every value")
        ->type_name("VALUE|below")
        ->group(group);
    add_number(app, "--no-data", typed.no_data, "Stored value that marks missing samples (with --missing)")
        ->type_name("VALUE")
        ->group(group);
    app.add_flag("--voxel", arguments.voxel_units, "Measure in voxels, not in the units of the file")->group(group);
}

void add_interpolant(CLI::App& app, Typed& typed) {
    app.add_option("--interpolant", typed.interpolant, "Connectivity inside cells: trilinear (default), or faces for the face rule alone")
        ->type_name("NAME")
        ->group("Input options");
    app.add_option("--tunnel-height", typed.tunnel_height, "Ignore tunnels through cells of at most this height (trilinear)")
        ->type_name("H|P%")
        ->group("Input options");
}

void add_output(CLI::App& app, Arguments& arguments, const std::string& formats, bool required) {
    CLI::Option* option =
        app.add_option("-o,--output", arguments.output, "Write to FILE (" + formats + "); an existing file is overwritten");
    option->type_name("FILE");
    if (required) option->required();
}

void add_tau(CLI::App& app, Typed& typed, const std::string& meaning) {
    add_number(app, "--tau", typed.tau, meaning + ", in the file's (calibrated) values")->type_name("T");
}

void add_gaussian(CLI::App& app, Typed& typed) {
    add_number(app, "--gaussian", typed.gaussian, "Gaussian filter first: standard deviation in the unit of the spacing")
        ->type_name("SIGMA");
}

void add_build(CLI::App& app, Arguments& arguments, Typed& typed) {
    add_gaussian(app, typed);
    app.add_option("--memory", typed.memory, "Memory budget, such as 1G or 500M; default: half of the available memory")->type_name("SIZE");
    app.add_flag("--restart", arguments.restart, "Discard the phases of an earlier build");
}

/// Options applied to the samples first.
void add_shape(CLI::App& app, Typed& typed) {
    add_gaussian(app, typed);
    app.add_option("--box", typed.box, "Only the samples FIRST:END (END not included) of each axis")->type_name("X:X,Y:Y[,Z:Z]");
}

void add_own(CLI::App& app, const std::string& verb, Arguments& arguments, Typed& typed) {
    if (verb == "tree") {
        app.add_option("--detail", typed.detail, "events, levels, elements or contours")->type_name("WHAT");
        add_selection(app, typed.selection, true);
        add_output(app, arguments, ".json .graphml .csv .vtu", false);
    } else if (verb == "info") {
        add_tau(app, typed, "Size of the surface at this isovalue and cost of reading it (stores)");
    } else if (verb == "objects") {
        add_tau(app, typed, "List every object at this isovalue");
        app.add_option("--top", typed.selection.top,
                       "At most N lines (without --tau: 24); with a percent sign: keep the first P percent of all objects")
            ->type_name("N|P%");
        add_selection(app, typed.selection, false);
        app.add_option("--curve", arguments.curve, "Write the number of objects for every threshold (.csv .svg .json)")->type_name("FILE");
        app.add_flag("--all", arguments.all, "All objects, also those that noise alone may explain");
        CLI::Option* cavities =
            app.add_flag("--cavities", arguments.cavities, "Cavities instead: voids and low-value regions inside objects");
        app.add_flag("--both", arguments.both, "Objects and cavities")->excludes(cavities);
    } else if (verb == "extract") {
        add_tau(app, typed, "Isovalue; default: the best isovalue of the object");
        add_number(app, "--object", arguments.objects, "Only these objects: ids of the table, or any voxel index inside")->type_name("ID");
        add_number(app, "--contour", arguments.contours, "Only these contours (ids of objects --tau)")->type_name("ID");
        app.add_option("--shell", typed.shell, "outer: outer shells, inner: walls of cavities, all")->type_name("WHICH");
        app.add_option("--style", typed.style, "compact: fewer triangles, full: an articulation point in every hit set")
            ->type_name("STYLE");
        app.add_option("--boundary", typed.boundary, "closed: caps at the border of the volume, open: no caps")->type_name("RULE");
        app.add_flag("--best", arguments.best, "The first object of the table at its best isovalue");
        add_output(app, arguments, ".ply .stl .obj .vtp .glb", true);
    } else if (verb == "render") {
        add_picture(app, arguments, typed.picture);
        add_camera(app, typed.picture);
        add_output(app, arguments, ".png .webp", true);
    } else if (verb == "animate") {
        add_animation(app, arguments);
        add_selection(app, typed.selection, false);
        add_picture(app, arguments, typed.picture);
        add_output(app, arguments, ".gif .webp .png .apng .mp4", true);
    } else if (verb == "label") {
        add_tau(app, typed, "Label the objects at this isovalue: 1 is the largest");
        app.add_flag("--cavities", arguments.cavities, "With --tau: label the cavities instead, 1 is the largest");
        app.add_flag("--zones", arguments.zones, "Label every voxel with its zone: event id + 1");
        add_selection(app, typed.selection, true);
        add_output(app, arguments, ".nrrd .nii .nii.gz .tif", true);
    } else if (verb == "build") {
        add_output(app, arguments, ".atlas", true);
        add_build(app, arguments, typed);
        app.add_flag("--dry-run", arguments.dry_run, "Only estimate memory, disk and time");
    } else if (verb == "atlas") {
        add_number(app, "--top", arguments.top, "At most N objects (24)")->check(in_range(1, 1000))->type_name("N");
        add_output(app, arguments, ".html", false);
        add_build(app, arguments, typed);
    } else if (verb == "view") {
        add_number(app, "--port", arguments.port, "Listen on this port of 127.0.0.1 (default: any free port)")
            ->check(in_range(1, 65535))
            ->type_name("N");
        app.add_flag("--no-browser", arguments.no_browser, "Only print the address");
        app.add_flag("--read-only", arguments.read_only, "Write nothing, not even a store");
        add_build(app, arguments, typed);
    } else if (verb == "ask") {
        add_output(app, arguments, "the response", false);
    } else if (verb == "handles") {
        app.add_flag("--exact", arguments.exact, "Exact pairs by persistent homology (slower)");
        add_number(app, "--object", arguments.objects, "With --exact: only the largest object with this highest voxel")->type_name("ID");
        app.add_option("--top", typed.selection.top, "At most N tunnels (24)")->type_name("N");
        app.add_option("--persistence", typed.selection.persistence, "Only tunnels of at least this persistence, or P percent of the range")
            ->type_name("H|P%");
    } else if (verb == "spectrum") {
        add_number(app, "--samples", arguments.samples, "Measure the surface at N isovalues, evenly spread (24); 0: none")
            ->check(in_range(std::int64_t{0}, std::int64_t{100000}))
            ->type_name("N");
        add_selection(app, typed.selection, true);
        add_output(app, arguments, ".csv .svg .json", false);
    } else if (verb == "table131") {
        add_shape(app, typed);
    } else if (verb == "convert") {
        add_shape(app, typed);
        add_output(app, arguments, ".nrrd .npy .raw .mha .nii", true);
    } else if (verb == "phantom") {
        app.add_flag("--list", arguments.list, "List the phantoms");
        add_number(app, "--size", arguments.phantom.size, "Samples per axis")
            ->check(in_range(std::int64_t{1}, std::int64_t{1} << 20))
            ->type_name("N");
        add_number(app, "--seed", arguments.phantom.seed, "Seed of random phantoms")->type_name("N");
        add_number(app, "--genus", arguments.phantom.genus, "Number of handles (torus-chain)")->type_name("N");
        add_number(app, "--shells", arguments.phantom.shells, "Number of shells (nested-shells)")->type_name("N");
        add_number(app, "--noise", arguments.phantom.noise, "Uniform noise of +- this fraction of the range")->type_name("F");
        add_number(app, "--quantise", arguments.phantom.quantise, "Number of grey levels, 2..65536")->type_name("N");
        add_output(app, arguments, ".nrrd .npy .raw .mha .nii", false);
    } else if (verb == "verify") {
        add_number(app, "--levels", arguments.levels, "Isovalues at which tree, cut and surface are compared")
            ->check(in_range(1, 100000))
            ->type_name("N");
        app.add_flag("--full", arguments.full, "Stores: every object at every isovalue, and the tree recomputed from the samples");
        add_number(app, "--seed", arguments.seed, "Stores: seed for drawing isovalues and objects (1)")->type_name("N");
    }
}

bool reads_volumes(const std::string& verb) { return verb != "phantom" && verb != "completion" && verb != "dump" && verb != "ask"; }

std::unique_ptr<CLI::App> make_parser(const Verb& verb, Arguments& arguments, Typed& typed) {
    auto app = std::make_unique<CLI::App>(verb.summary, "isoatlas " + verb.name);
    CLI::Option* operand = app->add_option(verb.operand, arguments.file,
                                           reads_volumes(verb.name) ? "The file (or folder of slices)"
                                           : verb.name == "dump"    ? "The store"
                                           : verb.name == "ask"     ? "Address that `isoatlas view` printed"
                                                                    : "");
    operand->type_name("");
    if (verb.name != "phantom") operand->required();
    if (verb.name == "dump") app->add_option("PART", arguments.part, "Part to print; default: a list of all parts")->type_name("");
    if (verb.name == "ask")
        app->add_option("REQUEST", arguments.part, "Path, such as '/api/objects?tau=300' (docs/server.md)")->type_name("");
    add_own(*app, verb.name, arguments, typed);
    if (reads_volumes(verb.name)) add_reading(*app, arguments, typed);
    if (reads_volumes(verb.name) && verb.name != "info" && verb.name != "convert") add_interpolant(*app, typed);
    add_talking(*app, arguments);
    app->get_formatter()->column_width(34);
    std::string examples = "Examples:\n";
    for (const std::string& example : verb.examples) examples += "  " + example + "\n";
    app->footer(examples + "\nExit codes: isoatlas --help. More: docs/cli.md");
    return app;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

void convert(const CLI::App& app, const Typed& typed, Arguments& arguments) {
    const auto given = [&](const char* name) {
        const CLI::Option* option = app.get_option_no_throw(name);
        return option != nullptr && option->count() > 0;
    };
    if (given("--dims")) arguments.open.dims = parse_dims(typed.dims);
    if (given("--type")) arguments.open.type = parse_type(typed.type);
    if (given("--endian")) arguments.open.big_endian = parse_choice<bool>("--endian", typed.endian, {{"little", false}, {"big", true}});
    if (given("--skip")) arguments.open.skip_bytes = typed.skip;
    if (given("--spacing")) arguments.open.spacing = parse_vector("--spacing", typed.spacing, 1);
    if (given("--origin")) arguments.open.origin = parse_vector("--origin", typed.origin, 0);
    if (given("--box")) arguments.box = parse_box("--box", typed.box);
    if (given("--gaussian")) {
        if (!std::isfinite(typed.gaussian) || typed.gaussian <= 0)
            usage("--gaussian is not above 0", "give the standard deviation in the unit of the spacing that `isoatlas info` prints");
        arguments.gaussian = typed.gaussian;
    }
    if (given("--time-step")) arguments.open.time_step = typed.time_step;
    if (given("--missing")) arguments.missing = parse_missing(typed.missing);
    if (given("--no-data")) arguments.missing.no_data = typed.no_data;
    convert_selection(given, typed.selection, arguments);
    if (app.get_option_no_throw("--background") != nullptr) convert_picture(typed.picture, arguments.picture);
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
    arguments.detail = parse_choice<TreeDetail>("--detail", typed.detail,
                                                {{"events", TreeDetail::events},
                                                 {"levels", TreeDetail::levels},
                                                 {"elements", TreeDetail::elements},
                                                 {"contours", TreeDetail::contours}});
}

[[noreturn]] void explain(const CLI::App& app, const std::string& verb, const std::vector<std::string>& words, const std::string& message) {
    const std::vector<std::string> known = option_names(app);
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (word.rfind("--", 0) != 0 || word == "--" || std::count(known.begin(), known.end(), name) > 0) continue;
        const std::string near = nearest(name, known);
        usage("`isoatlas " + verb + "` has no option " + name,
              (near.empty() ? "" : "did you mean " + near + "? ") + ("all options: isoatlas " + verb + " --help"));
    }
    usage(message, "isoatlas " + verb + " --help");
}

/// Rejects empty values (an unset variable of a script): CLI11 would take the next word instead.
void refuse_empty_values(const CLI::App& app, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t sign = words[i].find('=');
        const std::string name = words[i].substr(0, sign);
        const CLI::Option* option = name.starts_with('-') ? app.get_option_no_throw(name) : nullptr;
        if (option == nullptr || option->get_items_expected_max() == 0) continue;
        const bool is_empty = sign == std::string::npos ? i + 1 < words.size() && words[i + 1].empty() : sign + 1 == words[i].size();
        if (is_empty) usage(name + " has an empty value", "give it a value, or omit it");
    }
}

[[noreturn]] void unknown_verb(const std::string& word) {
    std::vector<std::string> names{"help"};
    for (const Verb& verb : verbs()) names.push_back(verb.name);
    const std::string near = nearest(word, names);
    usage("there is no verb \"" + word + "\"", near.empty() ? "isoatlas --help" : "did you mean `isoatlas " + near + "`?", list_of(names));
}

/// Moves options before the verb behind it, so that `isoatlas --json info FILE` works. Returns the verb, "" if there is none.
std::string take_verb(std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--threads") {
            ++i;
        } else if (words[i].empty()) {
            usage("the verb or file is an empty word", "isoatlas --help");
        } else if (words[i][0] != '-') {
            const std::string verb = words[i];
            std::vector<std::string> before(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i));
            words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            words.insert(words.end(), before.begin(), before.end());
            return verb;
        }
    }
    return "";
}

Parsed parse_without_verb(const std::vector<std::string>& words) {
    Parsed parsed;
    if (words.empty()) parsed.text = greeting();
    for (const std::string& word : words) {
        if (word == "-h" || word == "--help") parsed.text = overview();
        if (word == "--version" && parsed.text.empty()) parsed.text = "isoatlas " ISOATLAS_VERSION "\n";
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
    if (find_verb(name) == nullptr && name != "help" && std::filesystem::exists(name, ignored)) {  // isoatlas FILE
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
    if (std::count(words.begin(), words.end(), "--version") > 0) return parse_without_verb({"--version"});
    refuse_empty_values(*parser, words);
    try {
        std::vector<std::string> reversed(words.rbegin(), words.rend());  // CLI11 takes words from the back
        parser->parse(std::move(reversed));
    } catch (const CLI::CallForHelp&) {
        parsed.text = parser->help();
        return parsed;
    } catch (const CLI::ParseError& error) {
        explain(*parser, name, words, error.what());
    }
    convert(*parser, typed, parsed.arguments);
    return parsed;
}

std::vector<std::string> options_of(const std::string& verb) {
    Arguments arguments;
    Typed typed;
    const Verb* found = find_verb(verb);
    return found == nullptr ? std::vector<std::string>{} : option_names(*make_parser(*found, arguments, typed));
}

}  // namespace isoatlas::cli
