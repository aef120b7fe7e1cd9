#include "mesh/select_cells.h"

#include <bit>
#include <charconv>
#include <string>
#include <unordered_map>

#include "base/big_vector.h"
#include "critical/bodies.h"
#include "field/slab_work.h"
#include "isoatlas/polarity.h"
#include "mesh/extract_level.h"

namespace isoatlas {
namespace {

std::string shortest(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string describe_voxel(const Extent& extent, std::int64_t voxel) {
    const Index3 at = extent.voxel(voxel);
    std::string text = "voxel " + std::to_string(voxel) + " (" + std::to_string(at[0]) + ", " + std::to_string(at[1]);
    return text + (extent.rank == 3 ? ", " + std::to_string(at[2]) : "") + ")";
}

/// The object (number) that contains a voxel.
ObjectNumber object_at(const TauLevel& level, const Components& components, std::int64_t voxel) {
    const Extent& extent = level.info().extent;
    if (voxel < 0 || voxel >= extent.voxels()) {
        throw Error(ErrorKind::not_found, {.where = "object " + std::to_string(voxel),
                                           .what = "there is no such voxel",
                                           .expected = "a voxel index from 0 to " + std::to_string(extent.voxels() - 1),
                                           .next = "list the objects at this isovalue and take one of their ids"});
    }
    const Index3 at = extent.voxel(voxel);
    const RunRow row = components.runs.row(at[1], at[2]);
    const RunId run = row.run_at(at[0] + 1);
    if (!row.is_high(run)) {
        const Calibration& calibration = level.info().calibration;
        const bool is_low = polarity_of(level.info()) == Polarity::low;
        throw Error(ErrorKind::not_found,
                    {.where = describe_voxel(extent, voxel),
                     .what = "its value " + shortest(calibration.reported(level.sample_at(voxel))) + (is_low ? " is above" : " is below") +
                             " the isovalue " + shortest(calibration.reported(level.tau)) + ", so no object contains it",
                     .next = std::string(is_low ? "raise" : "lower") +
                             " the isovalue, or list the objects at this isovalue and take one of their ids"});
    }
    return components.object_of(run);
}

ContourNumber contour_with_id(const std::unordered_map<std::int64_t, ContourNumber>& numbers, const TauLevel& level, std::int64_t id) {
    const auto found = numbers.find(id);
    if (found != numbers.end()) return found->second;
    throw Error(ErrorKind::not_found,
                {.where = "contour " + std::to_string(id),
                 .what = "there is no such contour at the isovalue " + shortest(level.info().calibration.reported(level.tau)),
                 .expected = "the highest voxel of an object or the lowest voxel of a cavity",
                 .next = "list the objects at this isovalue with their contours"});
}

/// The contour of a hit between two components.
std::int64_t contour_of(const Components& components, bool first_is_high, std::int32_t first, std::int32_t second) {
    const ObjectNumber object(first_is_high ? first : second);
    const LowNumber low(first_is_high ? second : first);
    return components.contour_between(object, low).number();
}

}  // namespace

void write_contours(const Components& components, const MeshDomain& domain, std::int64_t y, std::int64_t z, const RowOffsets& place,
                    Surface& surface) {
    const RowHits hits(domain, y, z);
    const auto write = [&](bool first_is_high, std::int32_t first, std::int32_t second, std::int64_t& point) {
        surface.contour[point++] = contour_of(components, first_is_high, first, second);
    };
    ComponentCursor here(components, y, z), here_y = here, here_z = here, next_y(components, y + 1, z), next_z(components, y, z + 1);
    std::int64_t x_point = place.point, y_point = place.first_y(), z_point = place.first_z();
    hits.candidates.for_each([&](std::int64_t w) {
        const auto for_bits = [&](std::uint64_t bits, auto&& visit) {
            for (; bits != 0; bits &= bits - 1) {
                const int bit = std::countr_zero(bits);
                visit(64 * w + bit, (hits.row[w] >> bit & 1) != 0);
            }
        };
        for_bits(hits.x(w), [&](std::int64_t p, bool high) {
            const std::int32_t first = here.at(p);
            write(high, first, here.at(p + 1), x_point);
        });
        for_bits(hits.y(w), [&](std::int64_t p, bool high) { write(high, here_y.at(p), next_y.at(p), y_point); });
        for_bits(hits.z(w), [&](std::int64_t p, bool high) { write(high, here_z.at(p), next_z.at(p), z_point); });
    });
}

void write_contours(const Components& components, const HighBits& high, const HitLine& line, Surface& surface) {
    const std::uint64_t* const row = high.row(line.y, line.z);
    ComponentCursor first(components, line.y, line.z), second(components, line.y + (line.axis == 1), line.z + (line.axis == 2));
    std::int64_t point = line.point;
    for (const std::int32_t p : line.positions) {
        const bool is_high = (row[p / 64] >> p % 64 & 1) != 0;
        surface.contour[point++] = contour_of(components, is_high, first.at(p), second.at(p + (line.axis == 0)));
    }
}

IdArray<ContourNumber, std::uint8_t> chosen_contours(const TauLevel& level, const Components& components, const SurfaceOptions& options) {
    if (!selects_components(options)) return {};
    IdArray<ObjectNumber, std::uint8_t> object_chosen(static_cast<std::size_t>(components.objects()), options.objects.empty());
    for (const std::int64_t voxel : options.objects) object_chosen[object_at(level, components, voxel)] = 1;

    IdArray<ContourNumber, std::uint8_t> chosen(static_cast<std::size_t>(components.contours()), options.contours.empty());
    if (!options.contours.empty()) {
        std::unordered_map<std::int64_t, ContourNumber> numbers;
        for (const ContourNumber contour : chosen.ids()) numbers.emplace(components.contour_id(contour).number(), contour);
        for (const std::int64_t id : options.contours) chosen[contour_with_id(numbers, level, id)] = 1;
    }
    for (const ContourNumber contour : chosen.ids()) {
        const bool outer = components.is_outer(contour);
        const bool shell_chosen = options.shell == ShellChoice::all || (options.shell == ShellChoice::outer) == outer;
        chosen[contour] = chosen[contour] && shell_chosen && object_chosen[components.object_of_contour(contour)];
    }
    return chosen;
}

ChosenComponents choose_components(const TauLevel& level, const ExtractOptions& options, const Context& context) {
    ChosenComponents components;
    if (!needs_representatives(options.surface)) return components;
    components.all = find_components(level, tunnel_height_of(options.interpolant, options.tunnel_height), context);
    components.contours = chosen_contours(level, *components.all, options.surface);
    return components;
}

void write_ids(const Components& components, const Context& context, Surface& surface) {
    resize_for_overwrite(surface.object, surface.contour.size());
    constexpr std::int64_t kBlock = 1 << 16;
    const auto count = static_cast<std::int64_t>(surface.contour.size());
    Context blocks = context;
    blocks.slab_slices = 1;
    for_each_slab(blocks, kSelectPhases["ids"], {(count + kBlock - 1) / kBlock, kBlock}, [&](const Slab& slab) {
        const std::int64_t end = std::min(count, slab.z_end * kBlock);
        for (std::int64_t i = slab.z_begin * kBlock; i < end; ++i) {
            const ContourNumber contour(surface.contour[i]);
            surface.object[i] = components.highest[components.object_of_contour(contour)].number();
            surface.contour[i] = components.contour_id(contour).number();
        }
    });
}

}  // namespace isoatlas
