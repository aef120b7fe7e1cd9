#include "data/chosen_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "text/interrupt.h"

namespace isoatlas::cli {
namespace {

Surface extract_one(Source& source, const ChosenObject& object, SurfaceOptions options) {
    (object.is_contour ? options.contours : options.objects) = {object.voxel};
    try {
        return source.extract(object.tau, options);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::not_found) throw;
        ErrorText text = error.text();
        text.where = fmt::format("{} at {}", title_of(object), object.tau_text);
        throw Error(ErrorKind::not_found, text);
    }
}

/// Letters and digits of a title; all else becomes one '-'.
std::string as_file_name(const std::string& title) {
    std::string name;
    for (const char c : title) {
        const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' ||
                              static_cast<unsigned char>(c) >= 0x80;
        if (is_plain) name += c;
        if (!is_plain && !name.ends_with('-')) name += '-';
    }
    return name;
}

}  // namespace

std::array<std::uint8_t, 3> bytes_of(const Colour& colour) {
    const auto byte = [](double part) { return static_cast<std::uint8_t>(std::lround(std::clamp(part, 0.0, 1.0) * 255)); };
    return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

std::vector<ChosenSurface> chosen_surfaces(Sides& sides, const std::vector<ChosenObject>& objects, const SurfaceOptions& options,
                                           std::vector<std::string>& notes) {
    std::vector<ChosenSurface> surfaces;
    std::map<std::tuple<Polarity, bool, double, std::int64_t>, std::string> written;  // what an object or contour is called
    for (const ChosenObject& object : objects) {
        stop_if_interrupted();
        Surface surface = extract_one(sides.source(object), object, options);
        if (surface.points.empty()) {
            notes.push_back(fmt::format("{} has no such surface at {}", title_of(object), object.tau_text));
            continue;
        }
        const std::int64_t id = object.is_contour ? object.voxel : surface.object.front();
        const auto [known, is_new] = written.try_emplace({object.polarity, object.is_contour, object.tau, id}, title_of(object));
        if (!is_new) {
            notes.push_back(fmt::format("{} is {} at {}: written once", title_of(object), known->second, object.tau_text));
            continue;
        }
        const Colour colour = colour_of(object, static_cast<std::int64_t>(surfaces.size()));
        surfaces.push_back({object, {std::move(surface), title_of(object), bytes_of(colour)}});
    }
    return surfaces;
}

std::string split_name(const std::string& output, const ChosenObject& object) {
    const std::size_t slash = output.rfind('/'), dot = output.rfind('.');
    const std::size_t end = dot == std::string::npos || (slash != std::string::npos && dot < slash) ? output.size() : dot;
    std::string name = output.substr(0, end) + "-" + reference_of(object);
    if (!object.name.empty()) name += "-" + as_file_name(object.name);
    if (!object.is_best) name += "-at-" + object.tau_text;
    return name + output.substr(end);
}

}  // namespace isoatlas::cli
