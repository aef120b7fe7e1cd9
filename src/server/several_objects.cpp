#include "server/several_objects.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "base/cancel.h"
#include "isoatlas/cavities.h"
#include "isoatlas/nested_labels.h"
#include "isoatlas/render.h"
#include "isoatlas/segmentation.h"
#include "isoatlas/surface.h"
#include "server/download.h"
#include "server/query_parameters.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxParts = 256;

/// Every one with an isovalue.
std::vector<NamedPart> parts_of(const SeveralObjects& all, QueryParameters& words) {
    std::vector<NamedPart> parts = named_parts(words, all.atlas, all.lines, kMaxParts);
    if (parts.empty()) throw Error(ErrorKind::usage, {.where = "object", .what = "which objects?", .next = "add object=REF,..."});
    for (const NamedPart& part : parts) {
        if (!part.tau)
            throw Error(ErrorKind::usage,
                        {.where = title_of(part), .what = "at which isovalue?", .expected = "v" + std::to_string(part.voxel) + "@T"});
    }
    return parts;
}

std::string name_of(const SeveralObjects& all, const NamedPart& part) {
    const double tau = all.atlas.info().calibration.reported(*part.tau);
    const ObjectName* name = find_object_name(all.names, part.is_contour, part.voxel, tau);
    if (name == nullptr && part.number > 0) {  // named at its best isovalue
        const NumberedLines::Line& line =
            (part.is_contour ? all.lines.cavities : all.lines.objects)[static_cast<std::size_t>(part.number - 1)];
        name = find_object_name(all.names, part.is_contour, line.voxel, all.atlas.info().calibration.reported(line.tau));
    }
    return name == nullptr ? title_of(part) : name->name;
}

std::array<std::uint8_t, 3> colour_of(const NamedPart& part, std::size_t place) {
    const Colour colour = part.number == 0  ? palette(static_cast<std::int64_t>(place))
                          : part.is_contour ? colour_of_cavity(part.number)
                                            : colour_of_object(part.number);
    const auto byte = [](double channel) { return static_cast<std::uint8_t>(std::lround(channel * 255)); };
    return {byte(colour.red), byte(colour.green), byte(colour.blue)};
}

/// As `isoatlas label`: the number of an object; cavities behind them; then what has none.
std::vector<std::int64_t> labels_of(const SeveralObjects& all, const std::vector<NamedPart>& parts) {
    std::vector<std::int64_t> labels;
    std::set<std::int64_t> taken;
    const auto table = static_cast<std::int64_t>(all.lines.objects.size());
    std::int64_t next = table;
    for (const NamedPart& part : parts) {
        const std::int64_t label = part.number == 0 ? 0 : part.is_contour ? table + part.number : part.number;
        labels.push_back(label != 0 && taken.insert(label).second ? label : 0);
        next = std::max(next, label);
    }
    for (std::int64_t& label : labels) {
        if (label == 0) label = ++next;
    }
    return labels;
}

}  // namespace

Response surfaces_answer(const SeveralObjects& all, const Request& request, const Context& context) {
    QueryParameters words(request.words);
    const std::vector<NamedPart> parts = parts_of(all, words);
    const std::string format = words.choice("format", {"ply", "stl", "obj", "vtp", "glb"}).value_or("glb");
    words.reject_unknown();
    std::vector<NamedSurface> surfaces;
    std::int64_t left = all.max_triangles;
    for (const NamedPart& part : parts) {
        SurfaceOptions options;
        (part.is_contour ? options.contours : options.objects) = {part.voxel};
        options.max_triangles = std::max<std::int64_t>(left, 1);
        Surface surface = all.atlas.extract(*part.tau, options, context);
        left -= static_cast<std::int64_t>(surface.triangles.size());
        surfaces.push_back({std::move(surface), name_of(all, part), colour_of(part, surfaces.size())});
    }
    Download download(format, context);
    (void)write_surfaces(download, surfaces);
    return file_answer(download.take());
}

Response segmentation_answer(const SeveralObjects& all, const Request& request, const Context& context) {
    QueryParameters words(request.words);
    const std::vector<NamedPart> parts = parts_of(all, words);
    const std::string format = words.choice("format", {"seg.nrrd", "nrrd", "nii", "nii.gz", "tif"}).value_or("seg.nrrd");
    words.reject_unknown();
    const std::vector<std::int64_t> numbers = labels_of(all, parts);
    std::vector<NestedPart> nested;
    for (std::size_t i = 0; i < parts.size(); ++i)
        nested.push_back({parts[i].is_contour, parts[i].voxel, *parts[i].tau, static_cast<std::uint32_t>(numbers[i])});
    std::optional<Volume> volume;
    std::optional<Analysis> analysis;
    const auto cavities = [&](double tau) {
        if (!volume) volume = all.atlas.volume(context), analysis = all.atlas.analysis();
        std::vector<std::int64_t> ids;
        return label_cavities(*volume, *analysis, tau, ids, context);
    };
    const auto objects = [&](double tau) { return all.atlas.cut(tau, {.label = true}, context).label; };
    const VolumeInfo& info = all.atlas.info();
    const std::vector<std::uint32_t> labels = nested_labels(info.extent.voxels(), nested, {objects, cavities});
    stop_if_cancelled(context);
    std::vector<std::int64_t> voxels(static_cast<std::size_t>(*std::ranges::max_element(numbers)) + 1, 0);
    for (const std::uint32_t label : labels) ++voxels[label];
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < parts.size(); ++i)
        segments.push_back({numbers[i], name_of(all, parts[i]), colour_of(parts[i], i), info.calibration.reported(*parts[i].tau),
                            voxels[static_cast<std::size_t>(numbers[i])]});
    std::ranges::sort(segments, {}, &Segment::number);
    Download download(format, context);
    (void)write_segmentation(download, labels, segments, info);
    return file_answer(download.take());
}

}  // namespace isoatlas
