#include "formats/volume/placed_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "formats/common/length_unit.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "isoatlas/units.h"

namespace isoatlas {
namespace {

constexpr std::size_t kAxes = 3;

std::optional<double> metres_of_unit(const std::string& unit) { return metres_in(unit_name(unit)); }

std::string label_of(const PlacedAxis& axis, std::size_t a) {
    return std::string("axis ") + "xyz"[a] + (axis.name.empty() ? "" : " (" + axis.name + ")");
}

/// The step of even places. Numbers that float32 has may have been rounded to it.
std::optional<double> even_step(const std::vector<double>& places) {
    if (places.size() < 2) return std::nullopt;
    constexpr double kTolerance = 1e-5;
    const double step = (places.back() - places.front()) / static_cast<double>(places.size() - 1);
    const bool is_single =
        std::ranges::all_of(places, [](double place) { return static_cast<double>(static_cast<float>(place)) == place; });
    const double largest = std::max(std::abs(places.front()), std::abs(places.back()));
    const double rounding = (is_single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon()) * largest;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double error = std::abs(places[i] - (places.front() + static_cast<double>(i) * step));
        if (!(error <= std::max(kTolerance * std::abs(step), rounding))) return std::nullopt;
    }
    return step;
}

/// Whether all differences have one sign.
bool is_monotone(const std::vector<double>& places) {
    if (!std::ranges::all_of(places, [](double place) { return std::isfinite(place); })) return false;
    const bool ascends = places.back() > places.front();
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] == places[i - 1] || (places[i] > places[i - 1]) != ascends) return false;
    }
    return true;
}

/// Leaves places that can be used: one for each sample.
void check_places(VolumeInfo& info, PlacedAxis& axis, std::size_t a) {
    std::vector<double>& places = axis.places;
    const auto size = static_cast<std::size_t>(info.extent.size[a]);
    if (places.empty()) return;
    if (places.size() == size + 1) {
        for (std::size_t i = 0; i < size; ++i) places[i] += (places[i + 1] - places[i]) / 2;
        places.pop_back();
        info.notes.push_back("the coordinates of " + label_of(axis, a) + " are those of the ends of samples");
    }
    if (places.size() == size && is_monotone(places)) return;
    info.notes.push_back("the coordinates of " + label_of(axis, a) +
                         (places.size() == size
                              ? " neither ascend nor descend: they were left out"
                              : " are " + std::to_string(places.size()) + " instead of " + std::to_string(size) + ": they were left out"));
    places.clear();
}

void set_unit(VolumeInfo& info, std::array<PlacedAxis, kAxes>& axes) {
    std::optional<double> first;
    std::string others;
    bool has_unit_of_length = true;
    for (const PlacedAxis& axis : axes) {
        if (axis.places.empty()) continue;
        const std::optional<double> metres = metres_of_unit(axis.unit);
        has_unit_of_length = has_unit_of_length && metres;
        if (!first && metres) {
            first = metres;
            info.geometry.unit = axis.unit;
        }
        others +=
            (others.empty() ? "" : ", ") + axis.name + (axis.name.empty() ? "" : " in ") + (axis.unit.empty() ? "no unit" : axis.unit);
    }
    if (!first || !has_unit_of_length) {
        info.geometry.unit.clear();
        const bool says_units =
            std::ranges::any_of(axes, [](const PlacedAxis& axis) { return !axis.places.empty() && !axis.unit.empty(); });
        if (says_units) info.notes.push_back("the axes have no common unit of length: " + others);
        return;
    }
    for (PlacedAxis& axis : axes) {
        if (axis.places.empty()) continue;
        const double factor = *metres_of_unit(axis.unit) / *first;
        if (std::abs(factor - 1) < 1e-12) continue;
        for (double& place : axis.places) place *= factor;
    }
}

}  // namespace

void set_placed_axes(VolumeInfo& info, std::array<PlacedAxis, kAxes> axes, std::array<bool, kAxes>& flipped) {
    const auto rank = static_cast<std::size_t>(info.extent.rank);
    for (std::size_t a = 0; a < rank; ++a) check_places(info, axes[a], a);
    set_unit(info, axes);
    bool is_even = true;
    for (std::size_t a = 0; a < rank; ++a) is_even = is_even && (axes[a].places.size() < 2 || even_step(axes[a].places));
    for (std::size_t a = 0; a < rank && is_even; ++a) {
        if (axes[a].places.empty()) continue;
        info.geometry.origin[a] = axes[a].places.front();
        if (const std::optional<double> step = even_step(axes[a].places)) set_axis_spacing(info, static_cast<int>(a), *step);
    }
    if (is_even) return;
    constexpr std::int64_t kMostIndices = std::int64_t{1} << 24;
    for (std::size_t a = 0; a < rank; ++a) {
        if (!axes[a].places.empty() || info.extent.size[a] <= kMostIndices) continue;
        info.notes.emplace_back("the coordinates are not even, and one axis has none: they were left out");
        return;
    }
    for (std::size_t a = 0; a < kAxes; ++a) {
        std::vector<double>& places = axes[a].places;
        for (std::int64_t i = 0; places.empty() && i < info.extent.size[a]; ++i)
            info.geometry.coordinates[a].push_back(static_cast<double>(i));
        if (places.empty()) continue;
        flipped[a] = places.back() < places.front();
        if (flipped[a]) std::ranges::reverse(places);
        info.geometry.coordinates[a] = std::move(places);
    }
}

}  // namespace isoatlas
