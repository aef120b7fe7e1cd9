#include "server/several_objects.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "base/cancel.h"
#include "isoatlas/cavities.h"
#include "isoatlas/nested_labels.h"
#include "isoatlas/render.h"
#include "isoatlas/segmentation.h"
#include "isoatlas/surface.h"
#include "server/download.h"
#include "server/fewer_triangles.h"
#include "server/query_parameters.h"
#include "server/unit_word.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxParts = 256;

/// Every one with an isovalue.
std::vector<NamedPart> parts_of(const SeveralObjects& all, QueryParameters& words) {
    std::vector<NamedPart> parts = named_parts(words, all.sides, kMaxParts);
    if (parts.empty()) throw Error(ErrorKind::usage, {.where = "object", .what = "which objects?", .next = "add object=REF,..."});
    for (const NamedPart& part : parts) {
        if (!part.tau)
            throw Error(ErrorKind::usage,
                        {.where = title_of(part), .what = "at which isovalue?", .expected = "v" + std::to_string(part.voxel) + "@T"});
    }
    return parts;
}

std::string name_of(const SeveralObjects& all, const NamedPart& part) {
    const Calibration& scale = all.sides.atlas(part.polarity).info().calibration;
    const bool is_second = all.sides.stores.has_both() && part.polarity == Polarity::low;
    const std::vector<ObjectName>& names = is_second ? all.low_names : all.names;
    const ObjectName* name = find_object_name(names, part.is_contour, part.voxel, scale.reported(*part.tau));
    if (name == nullptr && part.number > 0) {  // named at its best isovalue
        const NumberedLines& lines = all.sides.lines(part.polarity);
        const NumberedLines::Line& line = (part.is_contour ? lines.cavities : lines.objects)[static_cast<std::size_t>(part.number - 1)];
        name = find_object_name(names, part.is_contour, line.voxel, scale.reported(line.tau));
    }
    return name == nullptr ? title_of(part) : name->name;
}

std::array<std::uint8_t, 3> colour_of(const NamedPart& part, std::size_t place) {
    const bool is_low = part.polarity == Polarity::low;
    const Colour colour = part.number == 0            ? palette(static_cast<std::int64_t>(place))
                          : part.is_contour != is_low ? colour_of_cavity(part.number)
                                                      : colour_of_object(part.number);
    const auto byte = [](double channel) { return static_cast<std::uint8_t>(std::lround(channel * 255)); };
    return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

/// As `isoatlas label`: the number of an object; cavities behind them; then what has none. Parts of one polarity. after: the last label
/// that others have.
std::vector<std::int64_t> labels_of(const NumberedLines& lines, const std::vector<NamedPart>& parts, std::int64_t after) {
    std::vector<std::int64_t> labels;
    std::set<std::int64_t> taken;
    const auto table = static_cast<std::int64_t>(lines.objects.size());
    std::int64_t next = after > 0 ? after : table;
    for (const NamedPart& part : parts) {
        const std::int64_t label = part.number == 0 || after > 0 ? 0 : part.is_contour ? table + part.number : part.number;
        labels.push_back(label != 0 && taken.insert(label).second ? label : 0);
        next = std::max(next, label);
    }
    for (std::int64_t& label : labels) {
        if (label == 0) label = ++next;
    }
    return labels;
}

/// Labels per voxel of parts of one polarity.
std::vector<std::uint32_t> labels_of_side(const Atlas& atlas, const std::vector<NamedPart>& parts, const std::vector<std::int64_t>& numbers,
                                          const Context& context) {
    std::vector<NestedPart> nested;
    for (std::size_t i = 0; i < parts.size(); ++i)
        nested.push_back({parts[i].is_contour, parts[i].voxel, *parts[i].tau, static_cast<std::uint32_t>(numbers[i])});
    std::optional<Volume> volume;
    std::optional<Analysis> analysis;
    const auto cavities = [&](double tau) {
        if (!volume) volume = atlas.volume(context), analysis = atlas.analysis();
        std::vector<std::int64_t> ids;
        return label_cavities(*volume, *analysis, tau, ids, context);
    };
    const auto objects = [&](double tau) { return atlas.cut(tau, {.label = true}, context).label; };
    return nested_labels(atlas.info().extent.voxels(), nested, {objects, cavities});
}

/// Labels of all parts, those of low values behind the others, with a segment for each.
struct Labelled {
    std::vector<std::uint32_t> of_voxel{};
    std::vector<Segment> segments{};
};

Labelled labelled(const SeveralObjects& all, const std::vector<NamedPart>& parts, const Context& context) {
    Labelled found;
    std::int64_t after = 0;
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        std::vector<NamedPart> own;
        std::ranges::copy_if(parts, std::back_inserter(own), [&](const NamedPart& part) { return part.polarity == polarity; });
        if (own.empty()) continue;
        const Atlas& atlas = all.sides.atlas(polarity);
        const std::vector<std::int64_t> numbers = labels_of(all.sides.lines(polarity), own, after);
        std::vector<std::uint32_t> labels = labels_of_side(atlas, own, numbers, context);
        if (after == 0) {
            found.of_voxel = std::move(labels);
        } else {
            overlay_labels(found.of_voxel, labels);
        }
        after = std::ranges::max(numbers);
        for (std::size_t i = 0; i < own.size(); ++i) {
            const double tau = atlas.info().calibration.reported(*own[i].tau);
            found.segments.push_back({numbers[i], name_of(all, own[i]), colour_of(own[i], i), tau, 0, polarity});
        }
    }
    std::vector<std::int64_t> voxels(static_cast<std::size_t>(after) + 1, 0);
    for (const std::uint32_t label : found.of_voxel) ++voxels[label];
    for (Segment& segment : found.segments) segment.voxels = voxels[static_cast<std::size_t>(segment.number)];
    std::ranges::sort(found.segments, {}, &Segment::number);
    return found;
}

}  // namespace

Response surfaces_answer(const SeveralObjects& all, const Request& request, const Context& context) {
    QueryParameters words(request.words);
    const std::vector<NamedPart> parts = parts_of(all, words);
    const std::string format = words.choice("format", {"ply", "stl", "obj", "vtp", "glb", "vtkhdf"}).value_or("glb");
    const std::string unit = unit_of_lengths(words, all.sides.stores.main.info().geometry);
    FewerTriangles simplified(words);
    words.reject_unknown();
    std::vector<NamedSurface> surfaces;
    std::int64_t left = simplified.most_of(all.max_triangles);
    for (const NamedPart& part : parts) {
        SurfaceOptions options;
        (part.is_contour ? options.contours : options.objects) = {part.voxel};
        options.max_triangles = std::max<std::int64_t>(left, 1);
        const Atlas& atlas = all.sides.atlas(part.polarity);
        Surface surface = atlas.extract(*part.tau, options, context);
        left -= static_cast<std::int64_t>(surface.triangles.size());
        simplified.apply(surface, atlas.info(), context);
        surface.unit = unit;
        surfaces.push_back({std::move(surface), name_of(all, part), colour_of(part, surfaces.size())});
    }
    Download download(format, context);
    (void)write_surfaces(download, surfaces);
    return simplified.told(file_answer(download.take()));
}

Response segmentation_answer(const SeveralObjects& all, const Request& request, const Context& context) {
    QueryParameters words(request.words);
    const std::vector<NamedPart> parts = parts_of(all, words);
    const std::string format = words.choice("format", {"seg.nrrd", "nrrd", "nii", "nii.gz", "tif"}).value_or("seg.nrrd");
    VolumeInfo info = all.sides.stores.main.info();
    info.geometry.unit = unit_of_lengths(words, info.geometry);
    words.reject_unknown();
    const Labelled labels = labelled(all, parts, context);
    stop_if_cancelled(context);
    Download download(format, context);
    (void)write_segmentation(download, labels.of_voxel, labels.segments, info);
    return file_answer(download.take());
}

}  // namespace isoatlas
