#include "formats/common/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "formats/common/connectivity.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr double kWidth = 960, kHeight = 300, kLeft = 84, kRight = 180, kTop = 34, kBottom = 48;
constexpr double kInnerWidth = kWidth - kLeft - kRight, kInnerHeight = kHeight - kTop - kBottom;

std::string fixed(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", value);
    return text.data();
}

/// 1, 2 or 5 times a power of ten, about a fifth of the range.
double step_of(double range) {
    const double raw = range / 5, power = std::pow(10, std::floor(std::log10(raw)));
    const double part = raw / power;
    return power * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

class Panel {
public:
    Panel(const Plot& plot, double top) : plot_(plot), top_(top) {
        for (const PlotCurve& curve : plot.curves) {
            for (const auto& point : curve.points) y_high_ = std::max(y_high_, height(point[1]));
        }
        if (y_high_ <= 0) y_high_ = 1;
        x_range_ = plot.x_high > plot.x_low ? plot.x_high - plot.x_low : 1;
    }

    [[nodiscard]] std::string svg() const {
        std::string text =
            "<text class='title' x='" + fixed(kLeft) + "' y='" + fixed(top_ + 20) + "'>" + svg_text(plot_.title) + "</text>\n";
        text += axes();
        for (const PlotMark& mark : plot_.marks) text += mark_svg(mark);
        double legend = top_ + kTop + 8;
        for (const PlotCurve& curve : plot_.curves) {
            text += curve_svg(curve) + legend_svg(curve, legend);
            legend += 20;
        }
        return text;
    }

private:
    [[nodiscard]] double height(double y) const { return plot_.logarithmic ? (y < 1 ? 0 : 0.3 + std::log10(y)) : std::max(0.0, y); }
    [[nodiscard]] double x_of(double x) const { return kLeft + kInnerWidth * std::clamp((x - plot_.x_low) / x_range_, 0.0, 1.0); }
    [[nodiscard]] double y_of(double y) const { return top_ + kTop + kInnerHeight * (1 - height(y) / y_high_); }

    [[nodiscard]] std::string axes() const {
        std::string text;
        const double bottom = top_ + kTop + kInnerHeight;
        const double step = step_of(x_range_);
        for (double x = std::ceil(plot_.x_low / step) * step; x <= plot_.x_low + x_range_; x += step) {
            const std::string at = fixed(x_of(x));
            text += "<line class='grid' x1='" + at + "' x2='" + at + "' y1='" + fixed(top_ + kTop) + "' y2='" + fixed(bottom) + "'/>";
            text += "<text class='tick' x='" + at + "' y='" + fixed(bottom + 16) + "' text-anchor='middle'>" +
                    short_text(std::abs(x) < step / 1e6 ? 0 : x) + "</text>\n";
        }
        for (const double y : y_ticks()) {
            const std::string at = fixed(y_of(y));
            text +=
                "<line class='grid' x1='" + fixed(kLeft) + "' x2='" + fixed(kLeft + kInnerWidth) + "' y1='" + at + "' y2='" + at + "'/>";
            text += "<text class='tick' x='" + fixed(kLeft - 6) + "' y='" + fixed(y_of(y) + 4) + "' text-anchor='end'>" + short_text(y) +
                    "</text>\n";
        }
        text += "<text class='tick' x='" + fixed(kLeft + kInnerWidth / 2) + "' y='" + fixed(bottom + 36) + "' text-anchor='middle'>" +
                svg_text(plot_.x_name) + "</text>\n";
        return text;
    }
    [[nodiscard]] std::vector<double> y_ticks() const {
        std::vector<double> ticks{0};
        if (plot_.logarithmic) {
            for (double y = 1; height(y) <= y_high_; y *= 10) ticks.push_back(y);
        } else {
            const double step = step_of(y_high_);
            for (double y = step; y <= y_high_; y += step) ticks.push_back(y);
        }
        return ticks;
    }

    /// Per column of half a pixel the first, lowest, highest and last point: the other points are not visible.
    [[nodiscard]] std::vector<std::array<double, 2>> drawn(const PlotCurve& curve) const {
        std::vector<std::array<double, 2>> places;
        double before = 0;
        for (const auto& point : curve.points) {
            const double x = x_of(point[0]), y = y_of(point[1]);
            if (curve.steps && !places.empty()) places.push_back({x, before});
            places.push_back({x, y});
            before = y;
        }
        std::vector<std::array<double, 2>> kept;
        for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
            const double column = std::floor(2 * places[first][0]);
            std::size_t low = first, high = first;
            for (end = first; end < places.size() && std::floor(2 * places[end][0]) == column; ++end) {
                if (places[end][1] < places[low][1]) low = end;
                if (places[end][1] > places[high][1]) high = end;
            }
            std::array<std::size_t, 4> some{first, std::min(low, high), std::max(low, high), end - 1};
            for (std::size_t i = 0; i < some.size(); ++i) {
                if (i == 0 || some[i] != some[i - 1]) kept.push_back(places[some[i]]);
            }
        }
        return kept;
    }
    [[nodiscard]] std::string curve_svg(const PlotCurve& curve) const {
        std::string path;
        for (const auto& place : drawn(curve)) path += (path.empty() ? "M" : "L") + fixed(place[0]) + " " + fixed(place[1]);
        return "<path class='curve' stroke='" + curve.colour + "' stroke-width='" + (curve.thick ? "2.5" : "1.2") + "' d='" + path +
               "'><title>" + svg_text(curve.name) + "</title></path>\n";
    }
    [[nodiscard]] static std::string legend_svg(const PlotCurve& curve, double y) {
        const double x = kLeft + kInnerWidth + 14;
        return "<line stroke='" + curve.colour + "' stroke-width='" + (curve.thick ? "3" : "2") + "' x1='" + fixed(x) + "' x2='" +
               fixed(x + 18) + "' y1='" + fixed(y) + "' y2='" + fixed(y) + "'/><text class='tick' x='" + fixed(x + 24) + "' y='" +
               fixed(y + 4) + "'>" + svg_text(curve.name) + "</text>\n";
    }
    [[nodiscard]] std::string mark_svg(const PlotMark& mark) const {
        const std::string at = fixed(x_of(mark.x));
        return "<line class='mark' x1='" + at + "' x2='" + at + "' y1='" + fixed(top_ + kTop) + "' y2='" +
               fixed(top_ + kTop + kInnerHeight) + "'><title>" + svg_text(mark.words) + "</title></line>\n";
    }

    const Plot& plot_;
    double top_, y_high_ = 0, x_range_ = 1;
};

}  // namespace

std::string svg_text(const std::string& text) {
    std::string safe;
    for (const char c : decoded_text(text)) {
        switch (c) {
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '&': safe += "&amp;"; break;
            case '\'': safe += "&#39;"; break;
            case '"': safe += "&quot;"; break;
            default: safe += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
        }
    }
    return safe;
}

std::string svg_of(const std::vector<Plot>& plots) {
    const double height = kHeight * static_cast<double>(plots.size());
    std::string text = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " + fixed(kWidth) + " " + fixed(height) + "' width='" +
                       fixed(kWidth) + "' height='" + fixed(height) + "' role='img' font-family='sans-serif'>\n";
    text +=
        "<style>.title{font-size:14px;font-weight:bold;fill:#222}.tick{font-size:11px;fill:#444}.grid{stroke:#ddd}"
        ".mark{stroke:#999;stroke-dasharray:2 3}.curve{fill:none;stroke-linejoin:round}.page{fill:#fff}"
        "@media (prefers-color-scheme:dark){.title{fill:#eee}.tick{fill:#bbb}.grid{stroke:#333}.page{fill:#161616}}</style>\n"
        "<rect class='page' width='100%' height='100%'/>\n";
    for (std::size_t i = 0; i < plots.size(); ++i) text += Panel(plots[i], kHeight * static_cast<double>(i)).svg();
    return text + "</svg>\n";
}

}  // namespace isoatlas
