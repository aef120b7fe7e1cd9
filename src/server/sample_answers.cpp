#include "server/sample_answers.h"

#include <algorithm>

#include "isoatlas/error.h"
#include "isoatlas/isovalue.h"
#include "isoatlas/locate.h"
#include "server/answers.h"
#include "server/query_parameters.h"
#include "server/wire_samples.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kSliceSamples = 1 << 20, kMaxSliceSamples = 1 << 22;
constexpr std::int64_t kVolumeValues = 1 << 21, kMaxVolumeValues = 1 << 25;
constexpr std::size_t kMaxLocated = 256;

const char* const kBytes = "application/octet-stream";

[[noreturn]] void missing(const std::string& word, const std::string& expected) {
    throw Error(ErrorKind::usage, {.where = word, .what = "it is missing", .expected = expected});
}

void require_volume(const Atlas& atlas) {
    if (atlas.info().extent.rank == 3) return;
    throw Error(ErrorKind::unsupported, {.what = "a 2D image has no slices", .next = "open the image file"});
}

/// Does the object of one voxel contain another voxel at an isovalue?
bool holds(const Atlas& atlas, const Locator& sample, const NamedPart& object, const Context& context) {
    const std::optional<std::int64_t> own = sample.object(*object.tau);
    return own && (*own == object.voxel || own == Locator(atlas, object.voxel, context).object(*object.tau));
}

/// Every one with an isovalue.
std::vector<NamedPart> parts_at(QueryParameters& words, std::string_view name, const NumberedSides& sides) {
    std::vector<NamedPart> parts = named_parts(words, name, sides, kMaxLocated);
    for (const NamedPart& part : parts) {
        if (!part.tau) missing(std::string(name), "v" + std::to_string(part.voxel) + "@T, with an isovalue");
    }
    return parts;
}

}  // namespace

Response slice_answer(const Atlas& atlas, const Request& request, const Context& context) {
    require_volume(atlas);
    QueryParameters words(request.words);
    const std::optional<std::int64_t> axis = words.whole("axis", 0, 2);
    if (!axis) missing("axis", "0, 1 or 2");
    SampleBox box{{0, 0, 0}, atlas.info().extent.size};
    const std::int64_t size = box.end[*axis];
    const std::optional<std::int64_t> index = words.whole("index", 0, size - 1);
    if (!index) missing("index", "0 to " + std::to_string(size - 1));
    const std::int64_t max = words.whole("max", 1, kMaxSliceSamples).value_or(kSliceSamples);
    words.reject_unknown();
    box.begin[*axis] = *index, box.end[*axis] = *index + 1;
    std::int64_t step = 1;
    const auto count = [&] {
        std::int64_t samples = 1;
        for (int a = 0; a < 3; ++a) samples *= (box.end[a] - box.begin[a] + step - 1) / step;
        return samples;
    };
    while (count() > max) ++step;
    return {200, kBytes, wire_slice(atlas.samples(box, step, context), static_cast<int>(*axis), step), {}};
}

Response volume_answer(const Atlas& atlas, const Request& request, const Context& context) {
    require_volume(atlas);
    QueryParameters words(request.words);
    const std::int64_t max = words.whole("max", 1, kMaxVolumeValues).value_or(kVolumeValues);
    words.reject_unknown();
    return {200, kBytes, wire_volume(atlas.coarse(max, context), atlas.range(), atlas.info().calibration), {}};
}

Response at_answer(const NumberedSides& sides, const std::vector<NamedEntry>& entries, const Request& request, const Context& context) {
    const VolumeInfo& info = sides.stores.main.info();
    const Extent& extent = info.extent;
    QueryParameters words(request.words);
    const std::vector<std::int64_t> at = words.list("voxel", 0, *std::ranges::max_element(extent.size) - 1, 3);
    if (at.size() != 3) missing("voxel", "x,y,z: three whole numbers");
    for (std::size_t a = 0; a < 3; ++a) {
        if (at[a] >= extent.size[a]) missing("voxel", "less than " + std::to_string(extent.size[a]) + " along axis " + std::to_string(a));
    }
    const std::vector<NamedPart> objects = parts_at(words, "object", sides), contours = parts_at(words, "contour", sides);
    words.reject_unknown();
    const std::int64_t voxel = extent.index(at[0], at[1], at[2]);
    const Locator sample(sides.stores.main, voxel, context);
    const std::optional<Locator> low = sides.stores.has_both() ? std::optional(Locator(*sides.stores.low, voxel, context)) : std::nullopt;
    const auto of = [&](Polarity polarity) -> const Locator& { return low && polarity == Polarity::low ? *low : sample; };
    AtVoxel found{.voxel = {at[0], at[1], at[2]}, .position = {}, .value = info.calibration.reported(sample.value())};
    found.position = to_physical(info.geometry, {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
    for (const NamedPart& object : objects)
        found.objects.push_back(holds(sides.atlas(object.polarity), of(object.polarity), object, context));
    for (const NamedPart& contour : contours) found.contours.push_back(of(contour.polarity).cavity(*contour.tau) == contour.voxel);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const NamedEntry& entry = entries[i];
        const Locator& own = of(entry.polarity);
        const std::optional<std::int64_t> holder = entry.is_cavity ? own.cavity(entry.tau) : own.object(entry.tau);
        if (holder == entry.id) found.entries.push_back(static_cast<std::int64_t>(i));
    }
    std::ranges::stable_sort(found.entries, {}, [&](std::int64_t i) { return entries[i].voxels; });
    return {200, "application/json", at_json(found), {}};
}

}  // namespace isoatlas
