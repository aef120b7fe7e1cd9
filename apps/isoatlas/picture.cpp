// From words to pictures: what the options of `render` mean.
#include "picture.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "words.h"

namespace isoatlas::cli {
namespace {

[[noreturn]] void bad(const std::string& option, const std::string& word, const std::string& expected) {
    throw Error(ErrorKind::usage, {.what = option + " cannot be \"" + word + "\"", .expected = expected, .next = "write it like that"});
}

template <class T>
std::optional<T> number_in(const std::string& word, int base = 10) {
    T value{};
    const char* end = word.data() + word.size();
    std::from_chars_result result{};
    if constexpr (std::is_integral_v<T>) {
        result = std::from_chars(word.data(), end, value, base);
    } else {
        result = std::from_chars(word.data(), end, value);
        if (result.ec == std::errc{} && !std::isfinite(value)) return std::nullopt;
    }
    if (word.empty() || result.ec != std::errc{} || result.ptr != end) return std::nullopt;
    return value;
}

ShownObject shown_object(const std::string& word) {
    const std::size_t at = word.find('@');
    const std::optional<std::int64_t> id = number_in<std::int64_t>(word.substr(0, at));
    ShownObject object{.id = id.value_or(0), .tau = {}};
    if (at != std::string::npos) object.tau = number_in<double>(word.substr(at + 1));
    if (!id || (at != std::string::npos && !object.tau)) bad("--object", word, "an id of the table, or with its isovalue: 81275@150");
    return object;
}

Colour colour_of(const std::string& word) {
    const std::optional<std::uint32_t> bits =
        word.size() == 7 && word[0] == '#' ? number_in<std::uint32_t>(word.substr(1), 16) : std::nullopt;
    if (!bits) bad("--colour", word, "red, green and blue in hexadecimal: #56B4E9");
    return {(*bits >> 16 & 255) / 255.0, (*bits >> 8 & 255) / 255.0, (*bits & 255) / 255.0};
}

/// "x>12.5": what is cut away.
HalfSpace half_space(const std::string& word, const std::string& all) {
    const std::optional<double> offset = word.size() > 2 ? number_in<double>(word.substr(2)) : std::nullopt;
    if (!offset || word[0] < 'x' || word[0] > 'z' || (word[1] != '<' && word[1] != '>'))
        bad("--cut", all, "octant, half, or planes such as x>12.5,y<3");
    const double sign = word[1] == '>' ? 1 : -1;
    HalfSpace half{.normal = {0, 0, 0}, .offset = sign * *offset};
    half.normal[static_cast<std::size_t>(word[0] - 'x')] = sign;
    return half;
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

View from_angles(double around, double above) {
    const double a = around * std::numbers::pi / 180, b = above * std::numbers::pi / 180;
    return {.toward = {std::cos(b) * std::sin(a), -std::cos(b) * std::cos(a), std::sin(b)},
            .up = {-std::sin(b) * std::sin(a), std::sin(b) * std::cos(a), std::cos(b)}};
}

std::optional<View> view_of(const std::string& word) {
    if (word == "auto") return std::nullopt;
    if (word == "front") return from_angles(0, 0);
    if (word == "right") return from_angles(90, 0);
    if (word == "back") return from_angles(180, 0);
    if (word == "left") return from_angles(270, 0);
    if (word == "top") return from_angles(0, 90);
    if (word == "bottom") return from_angles(0, -90);
    const std::size_t comma = word.find(',');
    const std::optional<double> around = number_in<double>(word.substr(0, comma));
    const std::optional<double> above = comma == std::string::npos ? 0 : number_in<double>(word.substr(comma + 1));
    if (!around || !above) bad("--view", word, "auto, front, back, left, right, top, bottom, or angles such as 30,20");
    return from_angles(*around, *above);
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
    for (const std::string& word : words.objects) picture.objects.push_back(shown_object(word));
    for (const std::string& word : words.colours) picture.colours.push_back(colour_of(word));
    convert_cut(words.cut, picture);
    picture.view = view_of(words.view);
    convert_size(words.size, picture);
    picture.background =
        parse_choice<Background>("--background", words.background,
                                 {{"light", Background::light}, {"dark", Background::dark}, {"transparent", Background::transparent}});
}

}  // namespace isoatlas::cli
