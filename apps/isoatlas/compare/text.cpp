#include <cmath>

#include <fmt/format.h>

#include "compare/output.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

void print_surfaces(Terminal& terminal, const Comparison& found) {
    Table table({{"method", true},
                 {"section", true},
                 {"ms"},
                 {"triangles"},
                 {"points"},
                 {"size"},
                 {"beside it"},
                 {"components"},
                 {"of them wrong"},
                 {"Euler number"},
                 {"genus"},
                 {"edges of holes"},
                 {"non-manifold edges"},
                 {"zero-area triangles"},
                 {"voxels to trilinear"},
                 {"at most"},
                 {"from it at most"}});
    for (const ExtractedSurface& one : found.surfaces) {
        const auto of_surface = [&](std::int64_t count) { return one.is_points ? std::string("-") : count_text(count); };
        table.add({one.method.title, one.method.section, milliseconds(one.seconds), of_surface(one.triangles), count_text(one.points),
                   size_text(one.bytes), size_text(one.cost.bytes), of_surface(one.components), of_surface(one.wrong_components),
                   of_surface(one.euler), one.genus ? count_text(*one.genus) : std::string("-"), of_surface(one.hole_edges),
                   of_surface(one.non_manifold_edges), of_surface(one.zero_area_triangles),
                   distance_text(one.to_trilinear, one.to_trilinear.mean), distance_text(one.to_trilinear, one.to_trilinear.max),
                   distance_text(one.from_trilinear, one.from_trilinear.max)});
    }
    table.print(terminal);
    terminal.out()
        << "\nSurfaces are open where they leave the volume; the genus is that after a disk closes each rim. Wrong components cross other "
           "edges of the grid than any component of "
           "the\ntrilinear surface. Beside it: memory beside samples and surface. Voxels to trilinear: mean distance of what a\nmethod "
           "made to the trilinear surface, and the "
           "largest; from it: the largest the other way, which shows what is missing.\n";
    if (found.surface_part) terminal.out() << part_text(found) << '\n';
    terminal.out() << '\n';
}

void print_searches(Terminal& terminal, const Comparison& found) {
    Table table({{"method", true},
                 {"section", true},
                 {"build, ms"},
                 {"query, ms"},
                 {"cold, ms"},
                 {"cells looked at"},
                 {"nodes"},
                 {"blocks read"},
                 {"memory"},
                 {"file"}});
    bool is_complete = true;
    for (const SearchRun& one : found.searches) {
        if (!one.has_run()) {
            is_complete = is_complete && one.missing_memory == 0;
            const std::string memory = one.missing_memory > 0 ? "about " + size_text(one.missing_memory) : "-";
            table.add({one.method.title, one.method.section, "-", "-", "-", "-", "-", "-", memory, "-"});
            continue;
        }
        const bool is_file = one.file_bytes > 0;
        table.add({one.method.title, one.method.section, milliseconds(one.build_seconds), milliseconds(one.query.seconds),
                   one.cold_seconds ? milliseconds(*one.cold_seconds) : "-", count_text(one.query.cost.cells),
                   count_text(one.query.cost.nodes), is_file ? count_text(one.query.cost.blocks) : "-", size_text(one.bytes),
                   is_file ? size_text(one.file_bytes) : "-"});
    }
    table.print(terminal);
    terminal.out() << '\n'
                   << counted(found.active, "active cell") << " of " << count_text(found.cells)
                   << "; every method finds them all. Sections are those of the dissertation\n";
    for (const SearchRun& one : found.searches) {
        if (!one.refusal.empty()) terminal.out() << one.method.title << " left out: " << one.refusal << '\n';
    }
    if (!is_complete) terminal.out() << "Methods without times would have needed more memory than --memory allows\n";
}

void print_growth(Terminal& terminal, const Comparison& found) {
    const std::vector<Growth> all = growth_of(found);
    if (all.empty()) return;
    std::vector<Table::Column> columns{{"exponent of", true}};
    for (const Growth& growth : all) columns.push_back({growth.title});
    Table table(columns);
    for (const SearchRun& one : found.searches) {
        std::vector<std::string> row{one.method.title};
        for (const Growth& growth : all) {
            std::string cell = "-";
            for (const Growth::Line& line : growth.lines) {
                if (line.name == one.method.title && line.exponent) cell = fmt::format("{:.2f}", *line.exponent);
            }
            row.push_back(cell);
        }
        table.add(row);
    }
    terminal.out() << '\n';
    table.print(terminal);
    terminal.out() << "\nk: active cells, at " << counted(std::ssize(found.isovalues), "isovalue") << "; n: all cells, of "
                   << counted(std::ssize(found.sizes), "volume") << " of every so many samples\n";
}

}  // namespace

std::string milliseconds(double seconds) {
    const double ms = 1e3 * seconds;
    return fmt::format("{:.{}f}", ms, ms < 1 ? 3 : ms < 10 ? 2 : ms < 100 ? 1 : 0);
}

std::string distance_text(const SurfaceDistance& distance, double voxels) {
    return distance.samples == 0 ? "-" : fmt::format("{:.{}f}", voxels, voxels < 0.1 ? 4 : 2);
}

std::string size_text(std::int64_t bytes) { return bytes_text(static_cast<double>(bytes)); }

std::string part_text(const Comparison& found) {
    const SampleBox& part = *found.surface_part;
    return fmt::format(
        "Surfaces of more than a million cells take long: these are of the part {}:{},{}:{},{}:{} in the middle. --box makes "
        "those of a part that you choose, also of all samples.",
        part.begin[0], part.end[0], part.begin[1], part.end[1], part.begin[2], part.end[2]);
}

void print_text(Terminal& terminal, const Comparison& found) {
    if (!found.surfaces.empty()) print_surfaces(terminal, found);
    if (!found.searches.empty()) print_searches(terminal, found);
    print_growth(terminal, found);
}

}  // namespace isoatlas::cli
