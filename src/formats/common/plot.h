// A plot of curves as SVG: for light and dark pages and print, without scripts or embedded fonts.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace isoatlas {

/// Escapes text for content and attributes.
[[nodiscard]] std::string svg_text(const std::string& text);

struct PlotCurve {
    std::string name;
    std::string colour;                         ///< of CSS
    std::vector<std::array<double, 2>> points;  ///< x ascending
    bool steps = false;                         ///< constant up to the next point
    bool thick = false;
};

/// A vertical line with a label.
struct PlotMark {
    double x;
    std::string words;
};

struct Plot {
    std::string title, x_name, y_name;
    double x_low = 0, x_high = 1;
    bool logarithmic = false;  ///< y: zero is drawn below one, so counts need no special case
    std::vector<PlotCurve> curves;
    std::vector<PlotMark> marks;
};

/// Plots below each other. At most a few thousand points a curve are drawn, with every peak.
[[nodiscard]] std::string svg_of(const std::vector<Plot>& plots);

}  // namespace isoatlas
