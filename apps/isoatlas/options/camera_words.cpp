// Parses camera options and clipping planes.
#include <cmath>

#include "data/picture.h"
#include "options/words.h"

namespace isoatlas::cli {
namespace {

[[noreturn]] void bad_cut(const std::string& word) {
    throw Error(ErrorKind::usage, {.what = "--cut cannot be \"" + word + "\"",
                                   .expected = "octant, half, or planes such as x>12.5,y<3 or 0.6x-0.8z>20",
                                   .next = "use this form"});
}

/// "x", "-x", "0.6x", "+0.8z": a coefficient and its axis, taken from the front of `rest`.
bool take_term(std::string_view& rest, Vec3& normal) {
    const std::size_t end = rest.find_first_of("xyz");
    if (end == std::string_view::npos) return false;
    std::string_view number = rest.substr(0, end);
    double sign = 1, factor = 1;
    if (number.starts_with('+') || number.starts_with('-')) {
        sign = number[0] == '-' ? -1 : 1;
        number.remove_prefix(1);
    }
    if (!number.empty()) {
        const bool is_plain = !number.starts_with('+');  // of "--0.6x" one sign is left
        if (!is_plain || !read_number(number, factor) || !(factor >= 0) || !std::isfinite(factor)) return false;
    }
    normal[static_cast<std::size_t>(rest[end] - 'x')] += sign * factor;
    rest.remove_prefix(end + 1);
    return true;
}

}  // namespace

HalfSpace half_space(const std::string& word, const std::string& all) {
    const std::size_t compared = word.find_first_of("<>");
    if (compared == std::string::npos || compared == 0) bad_cut(all);
    HalfSpace half;
    for (std::string_view rest = std::string_view(word).substr(0, compared); !rest.empty();)
        if (!take_term(rest, half.normal)) bad_cut(all);
    const std::string_view number = std::string_view(word).substr(compared + 1);
    if (!read_number(number, half.offset) || !std::isfinite(half.offset) || half.normal == Vec3{0, 0, 0}) bad_cut(all);
    if (word[compared] == '>') return half;
    for (double& n : half.normal) n = -n;
    half.offset = -half.offset;
    return half;
}

std::optional<ShownCamera> shown_camera(const PictureWords& words) {
    if (words.eye.empty() && words.target.empty() && words.height == 0) return std::nullopt;
    if (words.eye.empty() || words.target.empty()) {
        throw Error(ErrorKind::usage, {.what = "--eye and --target must be given together",
                                       .expected = "--eye X,Y,Z --target X,Y,Z, physical",
                                       .next = "give both, or --view"});
    }
    ShownCamera camera{
        .eye = parse_vector("--eye", words.eye, 0), .target = parse_vector("--target", words.target, 0), .height = words.height};
    double squares = 0;
    for (std::size_t a = 0; a < 3; ++a) squares += (camera.eye[a] - camera.target[a]) * (camera.eye[a] - camera.target[a]);
    if (!(squares > 0) || !std::isfinite(squares))
        throw Error(ErrorKind::usage, {.what = "--eye and --target coincide or are too far apart", .next = "give two different positions"});
    if (camera.height == 0) camera.height = 2 * std::sqrt(squares) * std::tan(kHalfAngle);
    return camera;
}

Camera camera_of(const ShownCamera& shown, const PictureArguments& picture) {
    Camera camera{.projection = picture.perspective ? Projection::perspective : Projection::orthographic, .target = shown.target};
    Vec3 toward{};
    double squares = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        toward[a] = shown.eye[a] - shown.target[a];
        squares += toward[a] * toward[a];
    }
    camera.distance = std::sqrt(squares);
    for (double& t : toward) t /= camera.distance;
    camera.view = {.toward = toward, .up = picture.up};
    camera.height = shown.height;
    return camera;
}

}  // namespace isoatlas::cli
