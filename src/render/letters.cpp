// A stroke font on a grid, drawn for isoatlas: baseline at 2, small letters up to 7, capitals up to 9, descenders down to 0.
//
// A stroke is a list of points, two digits each (x, y); strokes are separated by blanks. Between its ends a stroke is a smooth curve that
// its inner points pull (a quadratic B-spline); two points make a straight line, one repeated point a dot.
#include <algorithm>
#include <cstddef>
#include <string_view>

#include "render/pen.h"

namespace isoatlas {
namespace {

constexpr const char* kUnknown = "0902 0949 4942 4202";

// From ' ' (32) to '~' (126).
constexpr const char* kLetters[] = {"",
                                    "0905 0202",
                                    "0907 2927",
                                    "1812 3832 0646 0444",
                                    "4849090646420203 2921",
                                    "0249 0909 4242",
                                    "4208192906020244",
                                    "0907",
                                    "29070320",
                                    "09272300",
                                    "2824 0747 4507 0547",
                                    "0545 2723",
                                    "1201",
                                    "0535",
                                    "1213",
                                    "0139",
                                    "290902424929",
                                    "0729 2922",
                                    "0709494602 0242",
                                    "0809494626 2646420203",
                                    "3932 3904 0444",
                                    "4909 0906 0647420203",
                                    "48490902424606 0604",
                                    "0949 4912",
                                    "290906464929 260602424626",
                                    "03024249090545 4547",
                                    "0202 0606",
                                    "1201 1616",
                                    "3805 3502",
                                    "0646 0444",
                                    "0835 3502",
                                    "0709494624 2222",
                                    "353315 353747090242",
                                    "0229 2942 1535",
                                    "0902 092949462606 062646422202 2202",
                                    "474909024244",
                                    "0902 092949422202 2202",
                                    "4909 0902 0242 0636",
                                    "4909 0902 0636",
                                    "474909024245 4525",
                                    "0902 4942 0646",
                                    "0902",
                                    "3934320204",
                                    "0902 4905 1642",
                                    "0902 0242",
                                    "0209 0924 2449 4942",
                                    "0209 0942 4249",
                                    "290902424929",
                                    "0902 092949452505",
                                    "290902424929 3442",
                                    "0902 092949452505 2542",
                                    "4849090646420203",
                                    "0949 2922",
                                    "090402424449",
                                    "0922 2249",
                                    "0912 1227 2732 3249",
                                    "0942 4902",
                                    "0926 4926 2622",
                                    "0949 4902 0242",
                                    "2909 0900 0020",
                                    "0931",
                                    "0929 2920 2000",
                                    "0729 2947",
                                    "0141",
                                    "0918",
                                    "353707023235 3732",
                                    "0902 050737320204",
                                    "363707023233",
                                    "3932 353707023235",
                                    "0535 353707023233",
                                    "39191712 0727",
                                    "3732300001 353707023235",
                                    "0902 0507373532",
                                    "0702 0909",
                                    "17121000 1919",
                                    "0902 3704 1532",
                                    "0902",
                                    "0702 0507272522 2527474542",
                                    "0702 0507373532",
                                    "050737320204 0405",
                                    "0700 050737320204",
                                    "3730 353707023235",
                                    "0702 050727",
                                    "3637070535320203",
                                    "19141232 0727",
                                    "0704023234 3732",
                                    "0722 2247",
                                    "0712 1226 2632 3247",
                                    "0732 3702",
                                    "0722 4710",
                                    "0737 3702 0232",
                                    "29181605 05141220",
                                    "0900",
                                    "09181625 25141200",
                                    "051635 3645"};

constexpr double kCapital = 7, kBaseline = 2, kGap = 1.7, kBlank = 2.2;

struct Letter {
    const char* strokes;
    bool blank;
};

/// The glyph at text[i]; advances i past it.
Letter next_letter(const std::string& text, std::size_t& i) {
    const auto first = static_cast<unsigned char>(text[i++]);
    if (first == ' ') return {"", true};
    if (first >= 32 && first < 127) return {kLetters[first - 32], false};
    std::string_view rest(text.data() + i - 1, text.size() - i + 1);
    while (i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80) ++i;
    if (rest.starts_with("\xC2\xB5") || rest.starts_with("\xCE\xBC")) return {"0704023234 3732 0700", false};           // micro
    if (rest.starts_with("\xC2\xB0")) return {"1908061727 1919", false};                                                // degree
    if (rest.starts_with("\xC3\x97")) return {"0337 0733", false};                                                      // times
    if (rest.starts_with("\xC3\x85") || rest.starts_with("\xE2\x84\xAB")) return {"0227 2742 1434 2918273829", false};  // angstrom
    return {kUnknown, false};
}

double width_of(const char* strokes) {
    double width = 0;
    for (const char* s = strokes; s[0] != 0 && s[1] != 0; s += s[0] == ' ' ? 1 : 2) {
        if (s[0] != ' ') width = std::max(width, static_cast<double>(s[0] - '0'));
    }
    return width;
}

Point2 middle(Point2 a, Point2 b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }

void bend(Line& line, Point2 from, Point2 by, Point2 to) {
    constexpr int kPieces = 6;
    for (int k = 1; k <= kPieces; ++k) {
        const double t = static_cast<double>(k) / kPieces, a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
        line.push_back({a * from.x + b * by.x + c * to.x, a * from.y + b * by.y + c * to.y});
    }
}

Line curve_through(const std::vector<Point2>& points) {
    if (points.size() < 3) return points;
    Line line{points[0]};
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Point2 end = i + 2 == points.size() ? points[i + 1] : middle(points[i], points[i + 1]);
        bend(line, line.back(), points[i], end);
    }
    return line;
}

void add_strokes(std::vector<Line>& lines, const char* strokes, Point2 at, double unit) {
    std::vector<Point2> points;
    const auto finish = [&] {
        if (!points.empty()) lines.push_back(curve_through(points));
        points.clear();
    };
    for (const char* s = strokes; s[0] != 0;) {
        if (s[0] == ' ' || s[1] == 0 || s[1] == ' ') {
            finish();
            ++s;
            continue;
        }
        points.push_back({at.x + (s[0] - '0') * unit, at.y - (s[1] - '0' - kBaseline) * unit});
        s += 2;
    }
    finish();
}

}  // namespace

std::vector<Line> letters(const std::string& text, Point2 at, double size) {
    const double unit = size / kCapital;
    std::vector<Line> lines;
    for (std::size_t i = 0; i < text.size();) {
        const Letter letter = next_letter(text, i);
        add_strokes(lines, letter.strokes, at, unit);
        at.x += unit * (letter.blank ? kBlank + kGap : width_of(letter.strokes) + kGap);
    }
    return lines;
}

double text_width(const std::string& text, double size) {
    double width = 0;
    for (std::size_t i = 0; i < text.size();) {
        const Letter letter = next_letter(text, i);
        width += letter.blank ? kBlank + kGap : width_of(letter.strokes) + kGap;
    }
    return text.empty() ? 0 : (width - kGap) * size / kCapital;
}

}  // namespace isoatlas
