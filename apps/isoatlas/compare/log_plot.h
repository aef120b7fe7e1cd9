// A plot with two logarithmic axes as SVG, and its legend: lines differ in marker and dashes, too, not in colour alone.
#pragma once

#include <string>

#include "compare/output.h"

namespace isoatlas::cli {

/// Both for light and dark pages, by the classes of the page's style.
[[nodiscard]] std::string log_plot_svg(const Growth& growth);
/// A list: a piece of each line, its name, and the exponent that fits it. variable: "k" or "n".
[[nodiscard]] std::string log_plot_legend(const Growth& growth, const std::string& variable);

}  // namespace isoatlas::cli
