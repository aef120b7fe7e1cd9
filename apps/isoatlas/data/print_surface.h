// extract --for-print
#pragma once

#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "text/document.h"

namespace isoatlas::cli {

/// Millimetres in a unit of length; 0: it is not known.
[[nodiscard]] double millimetres_in(const std::string& unit);

/// Drops specks, scales to millimetres, and adds what was done to a sum. notes: receives what the user should know.
void print_surface(Surface& surface, PrintReport& sum, std::vector<std::string>& notes);

/// "for printing: 1 piece in a box of 36 x 40 x 52 mm, 12 specks dropped, the largest of 0.4 mm³"
[[nodiscard]] std::string printing_text(const PrintReport& report);
[[nodiscard]] Json printing_json(const PrintReport& report);

}  // namespace isoatlas::cli
