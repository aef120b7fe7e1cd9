#include "formats/mesh/mesh_parts.h"

#include <algorithm>

#include "formats/common/byte_writer.h"
#include "formats/common/generator.h"
#include "formats/mesh/mesh_formats.h"

namespace isoatlas {

namespace {

void add_part(MeshParts& parts, const Surface& surface, std::string name, const SrgbBytes& colour) {
    const bool first = parts.parts.empty();
    MeshPart part{TurnedSurface(surface, parts.space), std::move(name), colour, parts.points};
    parts.points += static_cast<std::int64_t>(surface.points.size());
    parts.triangles += static_cast<std::int64_t>(surface.segments.empty() ? surface.triangles.size() : 0);  // curves have no triangles
    parts.segments += static_cast<std::int64_t>(surface.segments.size());
    const bool is_empty = surface.points.empty() && !first;
    parts.has_normals = (first || parts.has_normals) && (is_empty || !surface.normals.empty());
    parts.has_object = (first || parts.has_object) && (is_empty || !surface.object.empty());
    parts.has_contour = (first || parts.has_contour) && (is_empty || !surface.contour.empty());
    parts.parts.push_back(std::move(part));
}

/// To the last part.
void add_coarser(MeshParts& parts, std::span<const SimplifiedSurface> coarser, const std::string& file) {
    for (const SimplifiedSurface& version : coarser) check_surface(version.surface, file);
    parts.parts.back().coarser = coarser;
}

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& next) {
    throw Error(ErrorKind::usage, {.file = file, .what = what, .next = next});
}

std::string colour_text(const SrgbBytes& colour) {
    return std::to_string(colour[0]) + " " + std::to_string(colour[1]) + " " + std::to_string(colour[2]);
}

KeyValues pairs_of(const MeshParts& parts) {
    const Surface& first = parts.parts.front().surface();
    KeyValues pairs{{"generator", kGenerator}};
    if (!parts.named) pairs.emplace_back("tau", number_text(first.reported_tau));
    pairs.emplace_back("space", one_line(parts.space));
    if (!parts.unit.empty()) pairs.emplace_back("unit", one_line(parts.unit));
    for (const auto& pair : key_values(connectivity_of(parts))) pairs.push_back(pair);
    return pairs;
}

}  // namespace

Connectivity connectivity_of(const MeshParts& parts) {
    Connectivity all = connectivity_of(parts.parts.front().surface());
    const auto is_high = [](const MeshPart& part) { return part.surface().polarity == Polarity::high; };
    if (std::ranges::any_of(parts.parts, is_high)) all.polarity = Polarity::high;
    return all;
}

std::string turned_space(const std::string& space, PointSpace wanted) {
    if (wanted == PointSpace::volume || !is_anatomical(space)) return space;
    return wanted == PointSpace::ras ? "RAS" : "LPS";
}

TurnedSurface::TurnedSurface(const Surface& surface, const std::string& space) : surface_(&surface) {
    if (!is_anatomical(surface.space) || !is_anatomical(space)) return;
    for (std::size_t a = 0; a < 3; ++a) {
        flips_[a] = surface.space[a] != space[a];
        is_mirrored_ = is_mirrored_ != flips_[a];
    }
}

MeshParts mesh_parts(const Surface& surface, const SurfaceFileOptions& options, const std::string& file,
                     std::span<const SimplifiedSurface> coarser) {
    check_surface(surface, file);
    MeshParts parts;
    parts.space = turned_space(surface.space, options.space);
    parts.unit = surface.unit;
    add_part(parts, surface, {}, {});
    add_coarser(parts, coarser, file);
    return parts;
}

MeshParts mesh_parts(std::span<const NamedSurface> surfaces, const SurfaceFileOptions& options, const std::string& file) {
    if (surfaces.empty()) refuse(file, "there is no surface to write", "give at least one");
    const Surface& first = surfaces.front().surface;
    MeshParts parts;
    parts.named = true;
    parts.space = turned_space(first.space, options.space);
    parts.unit = first.unit;
    for (const NamedSurface& named : surfaces) {
        check_surface(named.surface, file);
        if (named.surface.space != first.space || named.surface.unit != first.unit)
            refuse(file, "the surfaces have different spaces or units of length", "write those of each volume into a file of their own");
        add_part(parts, named.surface, one_line(named.name), named.colour);
        add_coarser(parts, named.coarser, file);
    }
    if (parts.segments > 0 && parts.triangles > 0) refuse(file, "curves and triangles do not share a file", "write them into two files");
    return parts;
}

Real position_precision(const MeshParts& parts) {
    const auto is_wide = [](const MeshPart& part) { return position_precision(part.surface()) == Real::f64; };
    return std::ranges::any_of(parts.parts, is_wide) ? Real::f64 : Real::f32;
}

std::string comment_lines(const MeshParts& parts, const std::string& comment_mark) {
    std::string text;
    for (const auto& [key, value] : pairs_of(parts)) text += comment_mark + " " + key + " " + value + "\n";
    if (parts.says_space()) text += comment_mark + " SPACE=" + parts.space + "\n";
    for (std::size_t i = 0; parts.named && i < parts.parts.size(); ++i) {
        const MeshPart& part = parts.parts[i];
        text += comment_mark + " object " + std::to_string(i + 1) + " tau " + number_text(part.surface().reported_tau) + " colour " +
                colour_text(part.colour) + " name " + part.name + "\n";
    }
    return text;
}

}  // namespace isoatlas
