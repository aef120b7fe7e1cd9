#include "render/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/colours.h"
#include "render/pen.h"

namespace isoatlas {

ScaleBar scale_bar(double pixel_size, std::int64_t width, const std::string& unit) {
    const double max = pixel_size * static_cast<double>(width) / 4;
    const double power = std::pow(10, std::floor(std::log10(max)));
    double best = power;
    for (const double factor : {2.0, 5.0}) {
        if (factor * power <= max) best = factor * power;
    }
    char text[64];
    std::snprintf(text, sizeof text, "%.6g %s", best, unit.empty() ? "units" : unit.c_str());
    return {best, best / pixel_size, text};
}

namespace {

struct Style {
    double size, margin, line;
    Colour ink, rim;
};

Style style_of(const RenderOptions& options) {
    const auto side = static_cast<double>(std::min(options.width, options.height));
    const double size = options.text_size > 0 ? options.text_size : std::clamp(side / 48, 6.0, 64.0);
    const bool dark = options.background == Background::dark;
    return {size, 1.6 * size, std::max(1.0, 0.18 * size), ink_of(options.background), dark ? Colour{0, 0, 0} : Colour{1, 1, 1}};
}

void draw_scale_bar(const ScaleBar& bar, const Style& style, Image& image) {
    const double right = static_cast<double>(image.width) - style.margin, left = right - bar.pixels;
    const double y = static_cast<double>(image.height) - style.margin, tick = 0.45 * style.size;
    const std::vector<Line> lines{{{left, y}, {right, y}}, {{left, y - tick}, {left, y + tick}}, {{right, y - tick}, {right, y + tick}}};
    draw_lines(image, lines, 2.2 * style.line, style.rim, 0.6);
    draw_lines(image, lines, style.line, style.ink);
    const double x = (left + right) / 2 - text_width(bar.text, style.size) / 2;
    draw_text(image, bar.text, {x, y - 0.9 * style.size}, style.size, style.ink, style.rim);
}

void draw_legend(const Scene& scene, const Style& style, Image& image) {
    double y = style.margin;
    const auto entry = [&](const std::string& name, const Colour& colour) {
        if (name.empty()) return;
        const Point2 low{style.margin, y}, high{style.margin + 1.4 * style.size, y + style.size};
        fill_box(image, {low.x - style.line / 2, low.y - style.line / 2}, {high.x + style.line / 2, high.y + style.line / 2},
                 0.25 * style.size, style.ink);
        fill_box(image, low, high, 0.2 * style.size, colour);
        draw_text(image, name, {high.x + 0.7 * style.size, y + style.size}, style.size, style.ink, style.rim);
        y += 1.8 * style.size;
    };
    for (const SceneObject& object : scene.objects) entry(object.name, object.colour);
    for (const OpacityTent& bump : scene.volume.tents) entry(bump.name, bump.colour);
    for (const TransferCurve& curve : scene.volume.curves) entry(curve.name, curve.colour);
}

void draw_caption(const std::vector<std::string>& lines, const Style& style, Image& image) {
    double y = static_cast<double>(image.height) - style.margin - 1.8 * style.size * static_cast<double>(lines.size() - 1);
    for (const std::string& line : lines) {
        draw_text(image, line, {style.margin, y}, style.size, style.ink, style.rim);
        y += 1.8 * style.size;
    }
}

}  // namespace

void draw_overlay(const Scene& scene, const Camera& camera, const RenderOptions& options, Image& image) {
    const Style style = style_of(options);
    if (options.legend) draw_legend(scene, style, image);
    if (!options.caption.empty()) draw_caption(options.caption, style, image);
    if (!options.scale_bar || camera.projection != Projection::orthographic) return;
    const std::string unit = !scene.unit.empty() || scene.objects.empty() ? scene.unit : scene.objects[0].surface.unit;
    draw_scale_bar(scale_bar(camera.height / static_cast<double>(options.height), options.width, unit), style, image);
}

}  // namespace isoatlas
