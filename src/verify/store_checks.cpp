#include "verify/store_checks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/analysis_data.h"
#include "atlas/event_arrays.h"
#include "field/brick_grid.h"
#include "isoatlas/dump.h"
#include "store/container.h"

namespace isoatlas {
namespace {

/// Number i of a part of a store, in the order of samples.
double number_of(const StoreNumbers& numbers, std::size_t i) {
    return std::visit([i](const auto& list) { return static_cast<double>(list[i]); }, numbers);
}

std::array<double, 2> range_of(const Volume& volume, const Box& box) {
    const Extent& extent = volume.info.extent;
    return visit_samples(volume, [&](auto samples) {
        auto low = samples[static_cast<std::size_t>(extent.index(box.begin))], high = low;
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
                const auto row =
                    samples.subspan(static_cast<std::size_t>(extent.index(box.begin[0], y, z)), static_cast<std::size_t>(box.size(0)));
                const auto [min, max] = std::ranges::minmax(row);
                low = std::min(low, min), high = std::max(high, max);
            }
        }
        return std::array<double, 2>{static_cast<double>(low), static_cast<double>(high)};
    });
}

template <class Index, class I>
std::span<const typename I::Number> numbers(const IdArray<Index, I>& ids) {
    return numbers_of<I>(ids.items());
}

template <class Numbers>
void compare(const char* name, const Numbers& stored, const Numbers& expected, Check& check, double tolerance = 0) {
    if (stored.size() != expected.size()) {
        check.fail(std::string(name) + " has " + std::to_string(stored.size()) + " numbers, the samples give " +
                   std::to_string(expected.size()));
        return;
    }
    for (std::size_t i = 0; i < stored.size(); ++i) {
        if (stored[i] == expected[i]) continue;
        if (tolerance > 0 && std::abs(static_cast<double>(stored[i]) - static_cast<double>(expected[i])) <= tolerance) continue;
        check.fail(std::string(name) + "[" + std::to_string(i) + "] is " + std::to_string(stored[i]) + ", the samples give " +
                   std::to_string(expected[i]));
    }
}

}  // namespace

CheckResult bricks_hold_active_cells(const Atlas& atlas, const Volume& samples) {
    Check check("bricks_hold_active_cells");
    const BrickGrid grid(atlas.info().extent);
    const StoreDump store(atlas.info().path);
    const StoreNumbers low = store.read(store.find("volume/low"), 0, grid.count()),
                       high = store.read(store.find("volume/high"), 0, grid.count());
    const Calibration& scale = atlas.info().calibration;
    for (const BrickId b : grid.bricks()) {
        std::array<double, 2> range = range_of(samples, grid.box(b));
        if (scale.mirror) range = {scale.of_file(range[1]), scale.of_file(range[0])};
        const double stored_low = number_of(low, b.index()), stored_high = number_of(high, b.index());
        if (stored_low == range[0] && stored_high == range[1]) continue;
        check.fail("brick " + std::to_string(b.number()) + " has samples " + std::to_string(range[0]) + " to " + std::to_string(range[1]) +
                   " and its stored range is " + std::to_string(stored_low) + " to " + std::to_string(stored_high));
    }
    return check.result("ranges of " + std::to_string(grid.count()) + " bricks, for every isovalue");
}

double saddle_tolerance(const Atlas& atlas) {
    if (Container(atlas.info().path).contents().version >= kFirstExactVersion) return 0;
    return 0x1p-40 * std::max(std::abs(atlas.range()[0]), std::abs(atlas.range()[1]));
}

CheckResult stored_tree_equals_analysis(const Analysis& stored, const Analysis& expected, double tolerance) {
    Check check("stored_tree_equals_analysis");
    stored.data().visit([&]<class Id>(const IndexedArrays<Id>& own) {
        expected.data().visit([&]<class Other>(const IndexedArrays<Other>& fresh) {
            if constexpr (!std::is_same_v<Id, Other>) {
                check.fail("its ids have a different width");
            } else {
                compare("elements/value", own.arrays.value.items(), fresh.arrays.value.items(), check, tolerance);
                compare("elements/code", own.arrays.code.items(), fresh.arrays.code.items(), check);
                compare("elements/towards_outside", numbers(own.arrays.contours.other), numbers(fresh.arrays.contours.other), check);
                compare("events/voxels", own.arrays.voxels.items(), fresh.arrays.voxels.items(), check);
                compare("genus of contours", own.arrays.contours.half_chi.items(), fresh.arrays.contours.half_chi.items(), check);
                compare("parents of events", numbers(own.arrays.tree.parent), numbers(fresh.arrays.tree.parent), check);
            }
        });
    });
    return check.result(std::to_string(expected.element_count()) + " elements, " + std::to_string(expected.event_count()) + " events");
}

CheckResult stored_events_follow_from_elements(const Atlas& atlas, const Analysis& stored) {
    Check check("stored_events_follow_from_elements");
    if (!stores_events(stored)) return check.result("events are not stored for that many elements");
    if (const std::string wrong = first_wrong_event(Container(atlas.info().path, polarity_of(atlas.info())), stored); !wrong.empty())
        check.fail(wrong);
    return check.result(std::to_string(stored.event_count()) + " events");
}

bool are_same(const Surface& p, const Surface& q) {
    return p.points == q.points && p.normals == q.normals && p.triangles == q.triangles && p.segments == q.segments &&
           p.object == q.object && p.contour == q.contour;
}

SurfaceParts::SurfaceParts(const Surface& surface) : surface_(surface), place_(surface.points.size()) {
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        Part& part = parts_[surface.object[i]];
        place_[i] = static_cast<std::int64_t>(part.points.size());
        part.points.push_back(i);
    }
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) parts_[object_of(surface.triangles[i])].triangles.push_back(i);
    for (std::size_t i = 0; i < surface.segments.size(); ++i) parts_[object_of(surface.segments[i])].segments.push_back(i);
}

Surface SurfaceParts::of(std::int64_t object) const {
    Surface result;
    const auto found = parts_.find(object);
    if (found == parts_.end()) return result;
    for (const std::size_t i : found->second.points) {
        result.points.push_back(surface_.points[i]);
        if (!surface_.normals.empty()) result.normals.push_back(surface_.normals[i]);
        result.object.push_back(object);
        result.contour.push_back(surface_.contour[i]);
    }
    const auto add = [&](const std::vector<std::size_t>& kept, const auto& all, auto& simplices) {
        for (const std::size_t i : kept) {
            auto simplex = all[i];
            for (std::int64_t& point : simplex) point = place_[static_cast<std::size_t>(point)];
            simplices.push_back(simplex);
        }
    };
    add(found->second.triangles, surface_.triangles, result.triangles);
    add(found->second.segments, surface_.segments, result.segments);
    return result;
}

}  // namespace isoatlas
