// A pen that draws lines and letters of any size over a picture, with smooth edges.
#pragma once

#include <string>
#include <vector>

#include "isoatlas/render.h"

namespace isoatlas {

struct Point2 {
    double x = 0, y = 0;  ///< pixels from the upper left corner
};
using Line = std::vector<Point2>;

/// The lines of a text; a capital letter is `size` high, the baseline begins at `at`. UTF-8; characters without a glyph are boxes.
[[nodiscard]] std::vector<Line> letters(const std::string& text, Point2 at, double size);
[[nodiscard]] double text_width(const std::string& text, double size);

/// Draws lines of a width, round at their ends.
void draw_lines(Image& image, const std::vector<Line>& lines, double width, const Colour& colour, double opacity = 1);
/// A filled box with round corners.
void fill_box(Image& image, Point2 low, Point2 high, double rounding, const Colour& colour, double opacity = 1);
/// Text with an outline of another colour, readable on any background.
void draw_text(Image& image, const std::string& text, Point2 at, double size, const Colour& ink, const Colour& rim);

}  // namespace isoatlas
