// Parses the picture options of `render` and `animate`.
#include "data/picture.h"

#include <algorithm>
#include <cmath>

#include "options/words.h"

namespace isoatlas::cli {
namespace {

[[noreturn]] void bad(const std::string& option, const std::string& word, const std::string& expected) {
    throw Error(ErrorKind::usage, {.what = option + " cannot be \"" + word + "\"", .expected = expected, .next = "use this form"});
}

template <class T>
std::optional<T> number_in(const std::string& word, int base = 10) {
    T value{};
    if (!read_number(word, value, base) || !std::isfinite(static_cast<double>(value))) return std::nullopt;
    return value;
}

std::optional<Colour> colour_in(const std::string& word) {
    const std::optional<std::uint32_t> bits =
        word.size() == 7 && word[0] == '#' ? number_in<std::uint32_t>(word.substr(1), 16) : std::nullopt;
    if (!bits) return std::nullopt;
    return Colour{(*bits >> 16 & 255) / 255.0, (*bits >> 8 & 255) / 255.0, (*bits & 255) / 255.0};
}

Colour colour_of(const std::string& word) {
    const std::optional<Colour> colour = colour_in(word);
    if (!colour) bad("--colour", word, "red, green and blue in hexadecimal: #56B4E9");
    return *colour;
}

std::vector<std::string> split(const std::string& word, char at) {
    std::vector<std::string> parts{""};
    for (const char c : word) {
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

ShownMaterial shown_material(const std::string& word) {
    const std::vector<std::string> parts = split(word, ':');
    const char* expected =
        "name, mean, standard deviation above 0, colour and, if not 0.1, opacity of a voxel below 1: fat:80:12:#E0C040:0.1";
    if (parts.size() < 4 || parts.size() > 5 || parts[0].empty()) bad("--material", word, expected);
    const std::optional<double> mean = number_in<double>(parts[1]), sigma = number_in<double>(parts[2]);
    const std::optional<Colour> colour = colour_in(parts[3]);
    const std::optional<double> opacity = parts.size() == 5 ? number_in<double>(parts[4]) : 0.1;
    if (!mean || !sigma || !(*sigma > 0) || !colour || !opacity || !(*opacity >= 0 && *opacity < 1)) bad("--material", word, expected);
    return {.name = parts[0], .mean = *mean, .sigma = *sigma, .colour = *colour, .opacity = *opacity};
}

[[noreturn]] void bad_curve(const std::string& what, const std::string& expected) {
    throw Error(ErrorKind::usage, {.what = "--transfer: " + what,
                                   .expected = expected,
                                   .next = "give an opacity curve such as --transfer=300:0:#F0E8D0,400:0.3,1500:0.5"});
}

/// 300:0:#F0E8D0, or 300:0 behind another point, whose colour it has.
ShownCurve::Point shown_point(const std::string& word, const ShownCurve& before) {
    const std::vector<std::string> parts = split(word, ':');
    const auto expect = [&](bool holds, const char* expected) {
        if (!holds) bad_curve("\"" + word + "\" is not a point of an opacity curve", expected);
    };
    expect(parts.size() == 2 || parts.size() == 3, "a value, the opacity of a voxel and a colour: 300:0.1:#F0E8D0");
    const std::optional<double> value = number_in<double>(parts[0]), opacity = number_in<double>(parts[1]);
    expect(value.has_value(), "a finite number as the value");
    expect(opacity && *opacity >= 0 && *opacity < 1, "an opacity from 0 to below 1");
    expect(parts.size() == 3 || !before.points.empty(), "a colour at the first point: 300:0.1:#F0E8D0");
    const std::optional<Colour> colour = parts.size() == 3 ? colour_in(parts[2]) : before.points.back().colour;
    expect(colour.has_value(), "red, green and blue in hexadecimal: #F0E8D0");
    return {.value = *value, .opacity = *opacity, .colour = *colour};
}

ShownCurve shown_curve(const std::string& word) {
    ShownCurve curve;
    for (const std::string& point : split(word, ',')) {
        curve.points.push_back(shown_point(point, curve));
        const std::size_t n = curve.points.size();
        if (n > 1 && curve.points[n - 1].value < curve.points[n - 2].value)
            bad_curve("the value of \"" + point + "\" is below that of the point before it", "points with rising values");
    }
    if (curve.points.size() < 2)
        bad_curve("\"" + word + "\" is one point", "at least two points; nothing is seen before the first and behind the last");
    return curve;
}

void convert_cut(const std::string& word, PictureArguments& picture) {
    if (word == "octant") picture.cut = CutShape::octant;
    if (word == "half") picture.cut = CutShape::half;
    if (picture.cut != CutShape::none || word.empty()) return;
    picture.cut = CutShape::planes;
    for (std::size_t begin = 0; begin <= word.size();) {
        const std::size_t end = std::min(word.find(',', begin), word.size());
        picture.planes.push_back(half_space(word.substr(begin, end - begin), word));
        begin = end + 1;
    }
}

ShownSlice shown_slice(const std::string& word) {
    const std::optional<std::int64_t> index = word.size() > 2 && word[1] == '=' ? number_in<std::int64_t>(word.substr(2)) : std::nullopt;
    if (!index || word[0] < 'x' || word[0] > 'z') bad("--slice", word, "an axis and the number of a sample, from 0: z=40");
    return {.axis = word[0] - 'x', .index = *index};
}

std::optional<View> view_of(const std::string& word, const Vec3& up) {
    if (word == "auto") return std::nullopt;
    if (word == "front") return view_from(0, 0, up);
    if (word == "right") return view_from(90, 0, up);
    if (word == "back") return view_from(180, 0, up);
    if (word == "left") return view_from(270, 0, up);
    if (word == "top") return view_from(0, 90, up);
    if (word == "bottom") return view_from(0, -90, up);
    const std::size_t comma = word.find(',');
    const std::optional<double> around = number_in<double>(word.substr(0, comma));
    const std::optional<double> above = comma == std::string::npos ? 0 : number_in<double>(word.substr(comma + 1));
    if (!around || !above) bad("--view", word, "auto, front, back, left, right, top, bottom, or angles such as 30,20");
    return view_from(*around, *above, up);
}

void convert_size(const std::string& word, PictureArguments& picture) {
    const std::size_t cross = word.find_first_of("xX");
    const std::optional<std::int64_t> width = number_in<std::int64_t>(word.substr(0, cross));
    const std::optional<std::int64_t> height = cross == std::string::npos ? width : number_in<std::int64_t>(word.substr(cross + 1));
    if (!width || !height || *width < 16 || *height < 16 || *width > 16384 || *height > 16384)
        bad("--size", word, "pixels from 16 to 16384, such as 1024x768");
    picture.width = *width, picture.height = *height;
}

}  // namespace

Vec3 direction_of(const std::string& option, const std::string& word) {
    const std::string axis = word.starts_with('-') ? word.substr(1) : word;
    Vec3 way{0, 0, 0};
    if (axis == "x" || axis == "y" || axis == "z") {
        way[static_cast<std::size_t>(axis[0] - 'x')] = word == axis ? 1 : -1;
        return way;
    }
    const bool has_three = std::count(word.begin(), word.end(), ',') == 2;
    double squares = 0;
    if (has_three) way = parse_vector(option, word, 0);
    for (const double u : way) squares += u * u;
    if (!(squares > 0) || !std::isfinite(squares)) bad(option, word, "x, y, z, -x, -y, -z or a direction such as 0.5,0,0.866");
    for (double& u : way) u /= std::sqrt(squares);
    return way;
}

void convert_picture(const PictureWords& words, PictureArguments& picture) {
    picture.taus = words.taus;
    picture.opacities = words.opacities;
    for (const double tau : words.taus) {
        if (!std::isfinite(tau))
            throw Error(ErrorKind::usage, {.what = "--tau is not a finite number", .next = "give an isovalue that `isoatlas info` prints"});
    }
    for (const double opacity : words.opacities) {
        if (!(opacity > 0 && opacity <= 1)) bad("--opacity", std::to_string(opacity), "above 0 and at most 1");
    }
    const auto add = [&](const char* option, const std::vector<std::string>& typed, ShownPart part) {
        for (ObjectReference& reference : parse_references(option, typed)) picture.objects.push_back({std::move(reference), part});
    };
    add("--object", words.objects, ShownPart::object);
    add("--contour", words.contours, ShownPart::contour);
    add("--cavities", words.cavities, ShownPart::cavities);
    for (const std::string& word : words.colours) picture.colours.push_back(colour_of(word));
    for (const std::string& word : words.slices) picture.slices.push_back(shown_slice(word));
    for (const std::string& word : words.materials) picture.materials.push_back(shown_material(word));
    for (const std::string& word : words.curves) picture.curves.push_back(shown_curve(word));
    picture.volume = picture.volume || !picture.materials.empty() || !picture.curves.empty();
    if (picture.flat && picture.slices.empty())
        throw Error(ErrorKind::usage, {.what = "--flat requires a slice", .next = "add --slice z=N, with N from 0"});
    convert_cut(words.cut, picture);
    picture.up = direction_of("--up", words.up);
    picture.view = view_of(words.view, picture.up);
    picture.camera = shown_camera(words);
    convert_size(words.size, picture);
    picture.background =
        parse_choice<Background>("--background", words.background,
                                 {{"light", Background::light}, {"dark", Background::dark}, {"transparent", Background::transparent}});
    convert_optics(words, picture);
}

}  // namespace isoatlas::cli
