#include "compare/log_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "compare/html.h"

namespace isoatlas::cli {
namespace {

constexpr double kWidth = 640, kHeight = 400, kLeft = 70, kRight = 16, kTop = 12, kBottom = 52;
constexpr int kColours = 7, kMarkers = 8;

/// A marker around the origin.
std::string marker_path(int number) {
    constexpr std::array<const char*, kMarkers> paths{"M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0Z",
                                                      "M-3.5 -3.5H3.5V3.5H-3.5Z",
                                                      "M0 -4.6L4.4 3.4H-4.4Z",
                                                      "M0 -5L5 0L0 5L-5 0Z",
                                                      "M0 4.6L4.4 -3.4H-4.4Z",
                                                      "M-4 -4L4 4M-4 4L4 -4",
                                                      "M0 -5V5M-5 0H5",
                                                      "M-5 -2L0 -5L5 -2L3 4H-3Z"};
    return paths[static_cast<std::size_t>(number % kMarkers)];
}

std::string classes_of(int number) { return fmt::format("line c{} d{}", number % kColours, number / kColours % 3); }

/// "0.01", "1", "10k", "5M", "1G"
std::string tick_text(double value) {
    for (const auto& [unit, name] : {std::pair(1e12, "T"), std::pair(1e9, "G"), std::pair(1e6, "M"), std::pair(1e3, "k")}) {
        if (value >= 0.999 * unit) return fmt::format("{:.4g}{}", value / unit, name);
    }
    return fmt::format("{:.4g}", value);
}

class LogAxis {
public:
    LogAxis(double low, double high, double from, double to) : from_(from), to_(to) {
        const double middle = std::log10(low * high) / 2, half = std::max(0.25, 0.52 * std::log10(high / low));
        low_ = middle - half, high_ = middle + half;
    }
    [[nodiscard]] double at(double value) const { return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_); }
    /// Powers of ten; where there are few of them, 2 and 5 times these, too; where there are many, some.
    [[nodiscard]] std::vector<double> ticks() const {
        constexpr double kMost = 8, kFew = 2.5;
        const double step = std::max(1.0, std::ceil((high_ - low_) / kMost));
        std::vector<double> ticks;
        for (double power = std::floor(low_); power <= high_; power += step) {
            for (const double part : {1.0, 2.0, 5.0}) {
                const double tick = part * std::pow(10, power), place = std::log10(tick);
                if (place >= low_ && place <= high_ && (part == 1 || high_ - low_ < kFew)) ticks.push_back(tick);
            }
        }
        return ticks;
    }

private:
    double low_, high_, from_, to_;
};

/// Lowest and highest coordinate of all points.
std::array<double, 2> ends_of(const Growth& growth, std::size_t axis) {
    std::array<double, 2> range{INFINITY, 0};
    for (const Growth::Line& line : growth.lines) {
        for (const auto& point : line.points) range = {std::min(range[0], point[axis]), std::max(range[1], point[axis])};
    }
    return range;
}

std::string axes_svg(const Growth& growth, const LogAxis& across, const LogAxis& upwards) {
    constexpr double right = kWidth - kRight, bottom = kHeight - kBottom;
    std::string svg;
    for (const double tick : across.ticks()) {
        const double x = across.at(tick);
        svg += fmt::format(R"(<line class="grid" x1="{0:.1f}" x2="{0:.1f}" y1="{1}" y2="{2}"/>)", x, kTop, bottom);
        svg += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", x, bottom + 18, tick_text(tick));
    }
    for (const double tick : upwards.ticks()) {
        const double y = upwards.at(tick);
        svg += fmt::format(R"(<line class="grid" x1="{0}" x2="{1}" y1="{2:.1f}" y2="{2:.1f}"/>)", kLeft, right, y);
        svg += fmt::format(R"(<text x="{}" y="{:.1f}" text-anchor="end">{}</text>)", kLeft - 8, y + 4, tick_text(tick));
    }
    svg += fmt::format(R"(<rect class="frame" x="{}" y="{}" width="{}" height="{}"/>)", kLeft, kTop, right - kLeft, bottom - kTop);
    svg += fmt::format(R"(<text class="strong" x="{}" y="{}" text-anchor="middle">{}</text>)", (kLeft + right) / 2, kHeight - 10,
                       html_text(growth.x_name));
    svg += fmt::format(R"svg(<text class="strong" transform="translate(16 {}) rotate(-90)" text-anchor="middle">{}</text>)svg",
                       (kTop + bottom) / 2, html_text(growth.y_name));
    return svg;
}

std::string line_svg(const Growth::Line& line, const LogAxis& across, const LogAxis& upwards) {
    std::string path, markers;
    for (const auto& [x, y] : line.points) {
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", across.at(x), upwards.at(y));
        markers += fmt::format(R"svg(<path class="marker" transform="translate({:.1f} {:.1f})" d="{}"/>)svg", across.at(x), upwards.at(y),
                               marker_path(line.number));
    }
    return fmt::format(R"(<g class="{}"><title>{}</title><path d="{}"/>{}</g>)", classes_of(line.number), html_text(line.name), path,
                       markers);
}

}  // namespace

std::string log_plot_svg(const Growth& growth) {
    const auto [x_low, x_high] = ends_of(growth, 0);
    const auto [y_low, y_high] = ends_of(growth, 1);
    const LogAxis across(x_low, x_high, kLeft, kWidth - kRight), upwards(y_low, y_high, kHeight - kBottom, kTop);
    std::string svg = fmt::format(R"(<svg viewBox="0 0 {} {}" role="img" aria-label="{} over {}, both logarithmic; numbers below">)",
                                  kWidth, kHeight, html_text(growth.y_name), html_text(growth.x_name));
    svg += axes_svg(growth, across, upwards);
    for (const Growth::Line& line : growth.lines) svg += line_svg(line, across, upwards);
    return svg + "</svg>";
}

std::string log_plot_legend(const Growth& growth, const std::string& variable) {
    std::string html = R"(<ul class="lines">)";
    for (const Growth::Line& line : growth.lines) {
        html += fmt::format(
            R"svg(<li><svg viewBox="0 -8 40 16" aria-hidden="true"><g class="{}"><path d="M0 0H40"/><path class="marker" transform="translate(20 0)" d="{}"/></g></svg>{})svg",
            classes_of(line.number), marker_path(line.number), html_text(line.name));
        if (line.exponent) html += fmt::format(" <small>~ {}<sup>{:.2f}</sup></small>", variable, *line.exponent);
        html += "</li>";
    }
    return html + "</ul>";
}

}  // namespace isoatlas::cli
