// extract --for-print
#pragma once

#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

/// Millimetres in a unit of length; 0: it is not known.
[[nodiscard]] double millimetres_in(const std::string& unit);

/// What was done to all surfaces, and what it led to.
struct Printing {
    PrintReport report;
    double min_wall;  ///< limit of WallThickness::thin_area, mm
    /// Of several surfaces the smallest minimum and median, and the sum of the areas. None: the walls were not measured.
    std::optional<WallThickness> walls = WallThickness{};
};
[[nodiscard]] Printing printing_of(const Arguments& arguments);

/// Drops specks, scales to millimetres, measures the walls, and adds what was done to a sum. notes: receives what the user should know.
void print_surface(Surface& surface, Printing& sum, std::vector<std::string>& notes, const Context& context);

/// "for printing: 1 piece in a box of 36 x 40 x 52 mm, 12 specks dropped, the largest of 0.4 mm³", and a line about the walls
[[nodiscard]] std::string printing_text(const Printing& printing);
[[nodiscard]] Json printing_json(const Printing& printing);
/// Of walls that a printer may lose; empty: there are none.
[[nodiscard]] std::string thin_walls_text(const Printing& printing);

}  // namespace isoatlas::cli
