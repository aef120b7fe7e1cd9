// isoatlas verify: the guarantees, one by one; exit code 7 when one does not hold.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "data/against.h"
#include "data/sides.h"
#include "text/document.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

bool is_mesh(const std::string& path) {
    const std::string extension = lower_extension(path);
    return extension == ".ply" || extension == ".stl" || extension == ".obj" || extension == ".vtp" || extension == ".glb" ||
           extension == ".vtkhdf";
}

int exit_code(const std::vector<CheckResult>& checks) {
    const bool all = std::all_of(checks.begin(), checks.end(), [](const CheckResult& check) { return check.holds; });
    return all ? 0 : static_cast<int>(ErrorKind::verification);
}

void print_json(Terminal& terminal, Json head, const std::vector<CheckResult>& checks) {
    head["holds"] = exit_code(checks) == 0;
    head["checks"] = Json::array();
    for (const CheckResult& check : checks) {
        head["checks"].push_back({{"name", check.name}, {"holds", check.holds}, {"detail", check.detail}});
    }
    print(terminal, head);
}

const std::string& checked_file(const Arguments& arguments) { return arguments.mesh.empty() ? arguments.file : arguments.mesh; }

/// One line per guarantee and a last one for all, ended by `of_what`; with --quiet only what fails and the last one.
void print_text(Terminal& terminal, const Arguments& arguments, const std::vector<CheckResult>& checks, const std::string& of_what) {
    const auto all = static_cast<std::int64_t>(checks.size());
    std::int64_t failed = 0;
    std::size_t width = 25;
    for (const CheckResult& check : checks) width = std::max(width, check.name.size());
    for (const CheckResult& check : checks) {
        failed += check.holds ? 0 : 1;
        if (check.holds && arguments.quiet) continue;
        terminal.out() << (check.holds ? "holds  " : "FAILS  ") << fmt::format("{:<{}} ", check.name, width) << check.detail << '\n';
    }
    terminal.out() << shown_name(checked_file(arguments)) << ": "
                   << (failed == 0 ? "all " + counted(all, "guarantee") + " hold"
                                   : fmt::format("{} of {} FAIL", failed, counted(all, "guarantee")))
                   << of_what << '\n';
}

std::vector<CheckResult> check_mesh(const Arguments& arguments, Json& head) {
    const Mesh mesh = read_mesh(arguments.file);
    head["file"] = arguments.file;
    head["points"] = mesh.points.size();
    head["triangles"] = mesh.triangles.size();
    return verify_mesh(mesh);
}

/// Of the levels of detail beside the store, if there are any.
std::vector<CheckResult> check_levels(const std::string& store, Source& source) {
    const std::string path = levels_path(store, polarity_of(source.info()));
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return {};
    try {
        return verify_levels(Levels(path, source.atlas()), source.atlas(), source.context());
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        return {{"levels_can_be_read", false, error.what()}};
    }
}

std::vector<CheckResult> check_volume(const Arguments& arguments, Source& source, const AtlasVerifyOptions& options) {
    if (source.is_store()) {
        std::vector<CheckResult> checks = verify_atlas(source.atlas(), options, source.context());
        std::ranges::move(check_levels(arguments.file, source), std::back_inserter(checks));
        return checks;
    }
    const VerifyOptions of_volume{.levels = arguments.levels, .interpolant = source.interpolant(), .tunnel_height = source.tunnel_height()};
    return verify_volume(source.volume(), of_volume, source.context());
}

/// Of a store of both polarities, unless one is asked for, both.
std::vector<CheckResult> check_sides(const Arguments& arguments, Sides& sides, const AtlasVerifyOptions& options) {
    Source& source = sides.main();
    std::vector<CheckResult> checks = check_volume(arguments, source, options);
    const bool is_both = arguments.polarity ? arguments.polarity == PolarityChoice::both
                                            : source.is_store() && source.atlas().polarities() == PolarityChoice::both;
    if (!is_both) return checks;
    for (CheckResult& check : check_volume(arguments, sides.source(Polarity::low), options)) {
        check.name += "_of_low_values";
        checks.push_back(std::move(check));
    }
    return checks;
}

std::string sample_text(const AtlasVerifyOptions& options) {
    const std::string isovalues = fmt::format("{} isovalues drawn with seed {} and both ends of the range", options.levels, options.seed);
    return options.full
               ? "all objects at " + isovalues
               : fmt::format("{} objects at each of {}; --full checks all objects and recomputes the tree", options.objects, isovalues);
}

}  // namespace

int run_verify(const Arguments& arguments, Terminal& terminal) {
    Json head = document("verify");
    std::vector<CheckResult> checks;
    std::string of_what, distances;
    if (!arguments.mesh.empty()) {
        AgainstSurface against = verify_against(arguments, terminal);
        head = std::move(against.head);
        checks = std::move(against.report.checks);
        distances = against.distances;
    } else if (is_mesh(arguments.file)) {
        head["what"] = "mesh";
        checks = check_mesh(arguments, head);
    } else {
        Sides sides(arguments, terminal);
        Source& source = sides.main();
        const AtlasVerifyOptions options{.levels = arguments.levels, .full = arguments.full, .seed = arguments.seed};
        checks = check_sides(arguments, sides, options);
        of_what = ", " + interpolant_text(source.info(), source.interpolant(), source.tunnel_height());
        head = document("verify", source.info(), source.interpolant(), source.tunnel_height());
        head["what"] = source.is_store() ? "store" : "volume";
        head["levels"] = arguments.levels;
        if (source.is_store()) {
            head["sample"] = {{"full", options.full}, {"levels", options.levels}, {"seed", options.seed}};
            if (!options.full) head["sample"]["objects"] = options.objects;
            of_what += "; " + sample_text(options);
        }
    }
    if (arguments.json) {
        print_json(terminal, std::move(head), checks);
    } else {
        if (!distances.empty()) terminal.out() << distances << '\n';
        print_text(terminal, arguments, checks, of_what);
    }
    if (exit_code(checks) != 0) terminal.warn(checked_file(arguments) + ": a guarantee does not hold");
    return exit_code(checks);
}

}  // namespace isoatlas::cli
