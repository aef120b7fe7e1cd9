#include "verify/slice_checks.h"

#include <algorithm>
#include <cstdio>
#include <unordered_map>

#include "base/portable.h"

namespace isoatlas {
namespace {

std::string at(double tau) {
    std::string text(32, '\0');
    text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "at %.17g: ", tau)));
    return text;
}

/// A sample of the values of the volume, sorted and distinct, for isovalues by quantiles.
std::vector<double> sampled_values(const Volume& volume) {
    constexpr std::int64_t wanted = 1 << 16;
    const std::int64_t voxels = volume.info.extent.voxels();
    const std::int64_t step = std::max<std::int64_t>(1, voxels / wanted);
    std::vector<double> values;
    for (std::int64_t i = 0; i < voxels; i += step) values.push_back(volume.value(i));
    visit_samples(volume, [&](auto samples) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        values.push_back(static_cast<double>(*low));
        values.push_back(static_cast<double>(*high));
    });
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

std::vector<std::int64_t> genera_of(const Cut& cut, const CutObject& object) {
    std::vector<std::int64_t> genera;
    for (std::int64_t i = 0; i < object.contour_count; ++i)
        genera.push_back(cut.contours[static_cast<std::size_t>(object.first_contour + i)].genus);
    std::sort(genera.begin(), genera.end());
    return genera;
}

}  // namespace

std::vector<double> isovalues_to_check(const Volume& volume, int count) {
    const std::vector<double> values = sampled_values(volume);
    const auto last = static_cast<double>(values.size() - 1);
    std::vector<double> chosen;
    for (int k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(count == 1 ? last / 2 : last * k / (count - 1));
        const bool between = k % 2 == 1 && i + 1 < values.size();
        const double middle = between ? values[i] / 2 + values[i + 1] / 2 : values[i];
        chosen.push_back(middle > values[i] ? middle : values[i]);  // neighbours may have nothing between them
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

std::vector<double> random_isovalues(const Volume& volume, int count, std::uint64_t seed) {
    Random random(seed);
    const std::int64_t voxels = volume.info.extent.voxels();
    const auto sample = [&] { return volume.value(static_cast<std::int64_t>(random.unit() * static_cast<double>(voxels))); };
    std::vector<double> chosen;
    for (int k = 0; k < count; ++k) {
        const double first = sample();
        chosen.push_back(k % 2 == 0 ? first : first + random.unit() * (sample() - first));
    }
    visit_samples(volume, [&](auto samples) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        chosen.push_back(static_cast<double>(*low));
        chosen.push_back(static_cast<double>(*high));
    });
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

TreeAtLevels::TreeAtLevels(const Analysis& analysis, const std::vector<double>& isovalues) : objects_(isovalues.size()) {
    analysis.visit_object_contours([&](EventId id, std::span<const GenusCount> histogram) {
        const Event event = analysis.event(id);
        const auto begin = std::upper_bound(isovalues.begin(), isovalues.end(), event.zone.tau_low);
        const auto end = std::upper_bound(begin, isovalues.end(), event.zone.tau_high);
        if (begin == end) return;
        const std::int64_t max = event.object_voxels, min = max - event.zone.voxels;
        Object object{id, event.chi, event.b1, event.b2, min, max, {}};
        for (const GenusCount& entry : histogram)
            object.genera.insert(object.genera.end(), static_cast<std::size_t>(entry.count), entry.genus);
        for (auto tau = begin; tau != end; ++tau) objects_[static_cast<std::size_t>(tau - isovalues.begin())].push_back(object);
    });
}

std::vector<EventId> TreeAtLevels::owner(const Analysis& analysis, std::size_t i) const {
    std::vector<EventId> owner(static_cast<std::size_t>(analysis.event_count()), EventId::none());
    for (const Object& object : objects_[i]) owner[object.event.index()] = object.event;
    for (EventId id(analysis.event_count() - 1); id.exists(); id = id.previous()) {  // parents first
        const EventId parent = analysis.event(id).parent;
        if (!owner[id.index()].exists() && parent.exists()) owner[id.index()] = owner[parent.index()];
    }
    return owner;
}

void compare_tree_and_cut(const Analysis& analysis, const TreeAtLevels& tree, std::size_t i, const Cut& cut, const EventOfVoxel& event_of,
                          Check& check) {
    const auto& objects = tree.objects(i);
    if (objects.size() != cut.objects.size()) {
        check.fail(at(cut.tau) + std::to_string(objects.size()) + " objects in the tree, " + std::to_string(cut.objects.size()) +
                   " in the volume");
        return;
    }
    const std::vector<EventId> owner = tree.owner(analysis, i);
    std::vector<bool> taken(objects.size(), false);
    for (const CutObject& object : cut.objects) {
        const std::string name = at(cut.tau) + "object " + std::to_string(object.id);
        const EventId named = event_of(VoxelId(object.id)), event = named.exists() ? owner[named.index()] : named;
        const auto found =
            std::lower_bound(objects.begin(), objects.end(), event, [](const auto& entry, EventId id) { return entry.event < id; });
        if (!event.exists() || found == objects.end() || found->event != event ||
            taken[static_cast<std::size_t>(found - objects.begin())]) {
            check.fail(name + " has no event of its own in the tree");
            continue;
        }
        taken[static_cast<std::size_t>(found - objects.begin())] = true;
        if (found->chi != object.chi || found->b1 != object.b1 || found->b2 != object.b2)
            check.fail(name + " has different Betti numbers in the tree");
        if (found->max_voxels > 0 && (object.voxels < found->min_voxels || object.voxels > found->max_voxels))
            check.fail(name + " has more or fewer voxels than in the tree");
        if (found->genera != genera_of(cut, object)) check.fail(name + " has contours of different genera in the tree");
    }
}

void compare_arcs_and_cut(const Analysis& analysis, const Cut& cut, Check& check) {
    std::vector<std::int64_t> promised, found;
    for (std::int64_t id = 0; id < analysis.contour_arc_count(); ++id) {
        const ContourArc arc = analysis.contour_arc(id);
        if (cut.tau > arc.value_low && cut.tau <= arc.value_high) promised.push_back(arc.genus);
    }
    for (const CutContour& contour : cut.contours) found.push_back(contour.genus);
    std::sort(promised.begin(), promised.end());
    std::sort(found.begin(), found.end());
    if (promised.size() != found.size()) {
        check.fail(at(cut.tau) + std::to_string(promised.size()) + " contours in the contour tree, " + std::to_string(found.size()) +
                   " in the volume");
    } else if (promised != found) {
        check.fail(at(cut.tau) + "the contours have different genera in the contour tree");
    }
}

void compare_cut_and_mesh(const Cut& cut, const Surface& surface, const SurfaceReport& report, Check& check) {
    if (report.component_chi.size() != cut.contours.size()) {
        check.fail(at(cut.tau) + std::to_string(report.component_chi.size()) + " surface components for " +
                   std::to_string(cut.contours.size()) + " contours");
        return;
    }
    std::unordered_map<std::int64_t, std::int64_t> twice_chi;  // of a closed surface: 2 V - F, because 2 E = 3 F
    for (const std::int64_t contour : surface.contour) twice_chi[contour] += 2;
    for (const auto& triangle : surface.triangles) twice_chi[surface.contour[static_cast<std::size_t>(triangle[0])]] -= 1;
    if (twice_chi.size() != cut.contours.size()) check.fail(at(cut.tau) + "the surface has contour ids that the volume does not have");
    for (const CutContour& contour : cut.contours) {
        const auto found = twice_chi.find(contour.id);
        if (found == twice_chi.end()) {
            check.fail(at(cut.tau) + "contour " + std::to_string(contour.id) + " has no surface");
        } else if (found->second != 2 * (2 - 2 * contour.genus)) {
            check.fail(at(cut.tau) + "the surface of contour " + std::to_string(contour.id) + " does not have genus " +
                       std::to_string(contour.genus));
        }
    }
}

void compare_cut_and_curves(const Cut& cut, const Surface& surface, Check& check) {
    constexpr std::int64_t none = -1;
    std::vector<std::int64_t> next(surface.points.size(), none);
    std::vector<bool> entered(surface.points.size(), false);
    for (const auto& [from, to] : surface.segments) {
        if (next[static_cast<std::size_t>(from)] != none || entered[static_cast<std::size_t>(to)])
            check.fail(at(cut.tau) + "a point has more than two segments or they have inconsistent orientation");
        next[static_cast<std::size_t>(from)] = to;
        entered[static_cast<std::size_t>(to)] = true;
    }
    std::size_t curves = 0;
    std::vector<bool> seen(surface.points.size(), false);
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (seen[start]) continue;
        ++curves;
        std::size_t point = start;
        while (!seen[point]) {
            seen[point] = true;
            if (next[point] == none) {
                check.fail(at(cut.tau) + "a curve is not closed");
                break;
            }
            point = static_cast<std::size_t>(next[point]);
        }
    }
    if (curves != cut.contours.size())
        check.fail(at(cut.tau) + std::to_string(curves) + " curves for " + std::to_string(cut.contours.size()) + " contours");
}

}  // namespace isoatlas
