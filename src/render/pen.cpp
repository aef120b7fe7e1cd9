#include "render/pen.h"

#include <algorithm>
#include <cmath>

#include "render/colours.h"

namespace isoatlas {
namespace {

double distance_to(Point2 p, Point2 a, Point2 b) {
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// Paints a colour over a pixel.
void blend(std::uint8_t* pixel, const Colour& colour, double cover) {
    if (!(cover > 0)) return;
    const double under = pixel[3] / 255.0 * (1 - cover), opacity = under + cover;
    const double channels[3] = {colour.red, colour.green, colour.blue};
    for (int c = 0; c < 3; ++c) pixel[c] = byte_of((channels[c] * cover + pixel[c] / 255.0 * under) / opacity);
    pixel[3] = byte_of(opacity);
}

struct Window {
    std::int64_t x0, y0, x1, y1;  ///< one past the last pixel
};

Window window_of(const Image& image, Point2 low, Point2 high, double rim) {
    const auto cut = [](double x, std::int64_t max) { return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, max); };
    return {cut(low.x - rim, image.width), cut(low.y - rim, image.height), cut(high.x + rim + 1, image.width),
            cut(high.y + rim + 1, image.height)};
}

}  // namespace

void draw_lines(Image& image, const std::vector<Line>& lines, double width, const Colour& colour, double opacity) {
    Point2 low{1e9, 1e9}, high{-1e9, -1e9};
    for (const Line& line : lines) {
        for (const Point2& p : line) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    }
    if (low.x > high.x) return;
    const Window all = window_of(image, low, high, width);
    const std::int64_t across = all.x1 - all.x0;
    // By the nearest line, so that crossings are painted once.
    std::vector<float> cover(across * std::max<std::int64_t>(0, all.y1 - all.y0));
    const auto paint = [&](Point2 a, Point2 b) {
        const Window near = window_of(image, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}, width);
        for (std::int64_t y = near.y0; y < near.y1; ++y) {
            for (std::int64_t x = near.x0; x < near.x1; ++x) {
                const Point2 centre{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
                const double inside = std::clamp(width / 2 + 0.5 - distance_to(centre, a, b), 0.0, 1.0);
                float& c = cover[x - all.x0 + across * (y - all.y0)];
                c = std::max(c, static_cast<float>(inside));
            }
        }
    };
    for (const Line& line : lines) {
        if (line.size() == 1) paint(line[0], line[0]);
        for (std::size_t i = 1; i < line.size(); ++i) paint(line[i - 1], line[i]);
    }
    for (std::int64_t y = all.y0; y < all.y1; ++y) {
        for (std::int64_t x = all.x0; x < all.x1; ++x) blend(image.at(x, y), colour, opacity * cover[x - all.x0 + across * (y - all.y0)]);
    }
}

void fill_box(Image& image, Point2 low, Point2 high, double rounding, const Colour& colour, double opacity) {
    const Window window = window_of(image, low, high, 1);
    for (std::int64_t y = window.y0; y < window.y1; ++y) {
        for (std::int64_t x = window.x0; x < window.x1; ++x) {
            const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
            const double dx = std::max({low.x + rounding - px, px - high.x + rounding, 0.0});
            const double dy = std::max({low.y + rounding - py, py - high.y + rounding, 0.0});
            blend(image.at(x, y), colour, opacity * std::clamp(rounding + 0.5 - std::hypot(dx, dy), 0.0, 1.0));
        }
    }
}

void draw_text(Image& image, const std::string& text, Point2 at, double size, const Colour& ink, const Colour& rim) {
    const std::vector<Line> lines = letters(text, at, size);
    const double width = std::max(1.0, 0.14 * size);
    draw_lines(image, lines, width + std::max(2.0, 0.25 * size), rim, 0.6);
    draw_lines(image, lines, width, ink);
}

}  // namespace isoatlas
