#include "data/print_surface.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "text/values.h"

namespace isoatlas::cli {
namespace {

constexpr double kMinWall = 0.8;    // mm: two lines of the usual nozzle of 0.4 mm
constexpr double kThinPart = 1e-3;  // of the walls: less is no reason to warn

void note_once(std::vector<std::string>& notes, const std::string& note) {
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

/// surface: in millimetres.
void add_walls(const Surface& surface, Printing& sum, std::vector<std::string>& notes, const Context& context) {
    if (!sum.walls) return;
    try {
        const WallThickness walls = wall_thickness(surface, {.limit = sum.min_wall}, context);
        if (walls.triangles == 0) return;
        const bool is_first = sum.walls->triangles == 0;
        sum.walls->min = is_first ? walls.min : std::min(sum.walls->min, walls.min);
        sum.walls->median = is_first ? walls.median : std::min(sum.walls->median, walls.median);
        sum.walls->triangles += walls.triangles, sum.walls->area += walls.area, sum.walls->thin_area += walls.thin_area;
    } catch (const Error& error) {  // the file is what was asked for
        if (error.kind() != ErrorKind::resource && error.kind() != ErrorKind::unsupported) throw;
        sum.walls.reset();
        note_once(notes, "the walls were not measured: " + error.text().what);
    }
}

std::string thin_part(const WallThickness& walls) {
    const double percent = 100 * walls.thin_area / walls.area;
    return percent < 10 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

}  // namespace

double millimetres_in(const std::string& unit) {
    constexpr std::pair<const char*, double> units[] = {{"mm", 1},    {"cm", 10},   {"dm", 100},      {"m", 1000},  {"um", 1e-3},
                                                        {"µm", 1e-3}, {"μm", 1e-3}, {"micron", 1e-3}, {"nm", 1e-6}, {"in", 25.4}};
    const auto found = std::ranges::find_if(units, [&](const auto& one) { return unit == one.first; });
    return found == std::end(units) ? 0 : found->second;
}

Printing printing_of(const Arguments& arguments) { return {.report = {}, .min_wall = arguments.min_wall.value_or(kMinWall)}; }

void print_surface(Surface& surface, Printing& sum, std::vector<std::string>& notes, const Context& context) {
    const double millimetres = millimetres_in(surface.unit);
    if (millimetres == 0)
        note_once(notes, surface.unit.empty() ? "the volume has no unit of length: one unit is taken as 1 mm"
                                              : "the unit " + surface.unit + " is not known: one is taken as 1 mm");
    const PrintReport report = prepare_for_print(surface, {.millimetres = millimetres == 0 ? 1 : millimetres});
    PrintReport& all = sum.report;
    all.pieces += report.pieces, all.specks += report.specks, all.volume += report.volume;
    all.largest_speck = std::max(all.largest_speck, report.largest_speck);
    for (std::size_t a = 0; a < 3; ++a) all.size_mm[a] = std::max(all.size_mm[a], report.size_mm[a]);
    add_walls(surface, sum, notes, context);
}

std::string printing_text(const Printing& printing) {
    const PrintReport& report = printing.report;
    const auto& size = report.size_mm;
    std::string text = fmt::format("for printing: {} of {:.4g} x {:.4g} x {:.4g} mm, {:.4g} mm³", counted(report.pieces, "piece"), size[0],
                                   size[1], size[2], report.volume);
    if (report.specks > 0)
        text += fmt::format("; {} dropped, the largest of {:.3g} mm³", counted(report.specks, "speck"), report.largest_speck);
    if (!printing.walls || printing.walls->triangles == 0) return text;
    const WallThickness& walls = *printing.walls;
    text += fmt::format("\nwalls: {:.3g} mm thick at the median, {:.3g} mm at the thinnest", walls.median, walls.min);
    if (walls.thin_area > 0) text += fmt::format(", {} of them under {} mm", thin_part(walls), printing.min_wall);
    return text;
}

std::string thin_walls_text(const Printing& printing) {
    if (!printing.walls || !(printing.walls->thin_area > kThinPart * printing.walls->area)) return "";
    return fmt::format("{} of the walls are thinner than {} mm (--min-wall), the thinnest {:.2g} mm: a printer may lose them",
                       thin_part(*printing.walls), printing.min_wall, printing.walls->min);
}

Json printing_json(const Printing& printing) {
    const PrintReport& report = printing.report;
    Json json{{"pieces", report.pieces}, {"specks", report.specks},   {"largest_speck", report.largest_speck},
              {"volume", report.volume}, {"size_mm", report.size_mm}, {"walls", nullptr}};
    if (!printing.walls || printing.walls->triangles == 0) return json;
    const WallThickness& walls = *printing.walls;
    json["walls"] = {{"min", walls.min},
                     {"median", walls.median},
                     {"area", walls.area},
                     {"limit", printing.min_wall},
                     {"thin_part", walls.area > 0 ? walls.thin_area / walls.area : 0.0}};
    return json;
}

}  // namespace isoatlas::cli
