// isoatlas verify: the guarantees, one by one; exit code 7 when one does not hold.
#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "document.h"
#include "session.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

bool is_mesh(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension == ".ply" || extension == ".stl" || extension == ".obj" || extension == ".vtp" || extension == ".glb";
}

int exit_code(const std::vector<CheckResult>& checks) {
    const bool all = std::all_of(checks.begin(), checks.end(), [](const CheckResult& check) { return check.holds; });
    return all ? 0 : static_cast<int>(ErrorKind::verification);
}

void print_checks(Terminal& terminal, const Arguments& arguments, Json head, const std::vector<CheckResult>& checks) {
    if (arguments.json) {
        head["holds"] = exit_code(checks) == 0;
        head["checks"] = Json::array();
        for (const CheckResult& check : checks)
            head["checks"].push_back({{"name", check.name}, {"holds", check.holds}, {"detail", check.detail}});
        print(terminal, head);
    } else {
        for (const CheckResult& check : checks) {
            terminal.out() << (check.holds ? "holds  " : "FAILS  ") << fmt::format("{:<32}", check.name) << ' ' << check.detail << '\n';
        }
    }
    const auto failed = std::count_if(checks.begin(), checks.end(), [](const CheckResult& check) { return !check.holds; });
    if (failed > 0) {
        terminal.warn(fmt::format("{}: {} of {} do not hold", arguments.file, failed,
                                  counted(static_cast<std::int64_t>(checks.size()), "guarantee")));
    } else {
        terminal.say(fmt::format("{}: all {} hold", arguments.file, counted(static_cast<std::int64_t>(checks.size()), "guarantee")));
    }
}

std::vector<CheckResult> check_mesh(const Arguments& arguments, Json& head) {
    const Mesh mesh = read_mesh(arguments.file);
    head["file"] = arguments.file;
    head["points"] = mesh.points.size();
    head["triangles"] = mesh.triangles.size();
    return verify_mesh(mesh);
}

}  // namespace

int run_verify(const Arguments& arguments, Terminal& terminal) {
    Json head = document("verify");
    std::vector<CheckResult> checks;
    if (is_mesh(arguments.file)) {
        head["what"] = "mesh";
        checks = check_mesh(arguments, head);
    } else {
        Session session(arguments, terminal);
        const Volume volume = session.load();
        checks = verify_volume(volume, arguments.levels, session.context());
        head = document("verify", volume.info, arguments.interpolant);
        head["what"] = "volume";
        head["levels"] = arguments.levels;
    }
    print_checks(terminal, arguments, std::move(head), checks);
    return exit_code(checks);
}

}  // namespace isoatlas::cli
