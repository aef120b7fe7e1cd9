#include "data/print_surface.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "text/values.h"

namespace isoatlas::cli {

double millimetres_in(const std::string& unit) {
    constexpr std::pair<const char*, double> units[] = {{"mm", 1},    {"cm", 10},   {"dm", 100},      {"m", 1000},  {"um", 1e-3},
                                                        {"µm", 1e-3}, {"μm", 1e-3}, {"micron", 1e-3}, {"nm", 1e-6}, {"in", 25.4}};
    const auto found = std::ranges::find_if(units, [&](const auto& one) { return unit == one.first; });
    return found == std::end(units) ? 0 : found->second;
}

void print_surface(Surface& surface, PrintReport& sum, std::vector<std::string>& notes) {
    const double millimetres = millimetres_in(surface.unit);
    if (millimetres == 0) {
        const std::string note = surface.unit.empty() ? "the volume has no unit of length: one unit is taken as 1 mm"
                                                      : "the unit " + surface.unit + " is not known: one is taken as 1 mm";
        if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
    const PrintReport report = prepare_for_print(surface, {.millimetres = millimetres == 0 ? 1 : millimetres});
    sum.pieces += report.pieces, sum.specks += report.specks, sum.volume += report.volume;
    sum.largest_speck = std::max(sum.largest_speck, report.largest_speck);
    for (std::size_t a = 0; a < 3; ++a) sum.size_mm[a] = std::max(sum.size_mm[a], report.size_mm[a]);
}

std::string printing_text(const PrintReport& report) {
    const auto& size = report.size_mm;
    std::string text = fmt::format("for printing: {} of {:.4g} x {:.4g} x {:.4g} mm, {:.4g} mm³", counted(report.pieces, "piece"), size[0],
                                   size[1], size[2], report.volume);
    if (report.specks > 0)
        text += fmt::format("; {} dropped, the largest of {:.3g} mm³", counted(report.specks, "speck"), report.largest_speck);
    return text;
}

Json printing_json(const PrintReport& report) {
    return {{"pieces", report.pieces},
            {"specks", report.specks},
            {"largest_speck", report.largest_speck},
            {"volume", report.volume},
            {"size_mm", report.size_mm}};
}

}  // namespace isoatlas::cli
