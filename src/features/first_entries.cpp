// The first entries of a table of objects, their notes there, and texts for the reasons of their isovalues.
#include <algorithm>
#include <cmath>
#include <set>

#include "features/keep_entries.h"
#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"

namespace isoatlas {

const char* name_of(IsovalueReason reason) {
    switch (reason) {
        case IsovalueReason::stable: return "stable";
        case IsovalueReason::outline: return "outline";
        case IsovalueReason::outer: return "outer";
        case IsovalueReason::inner: return "inner";
        case IsovalueReason::merge: return "merge";
        case IsovalueReason::middle: return "middle";
    }
    return "";
}

const char* text_of(IsovalueReason reason) {
    switch (reason) {
        case IsovalueReason::stable: return "its size hardly depends on the isovalue here: its boundary is sharp";
        case IsovalueReason::outline: return "everything that is not background";
        case IsovalueReason::outer: return "its outside alone, as if its cavities were filled, is sharpest here";
        case IsovalueReason::inner: return "the wall of one of its cavities is sharpest here";
        case IsovalueReason::merge: return "as large as it gets before it merges with another object";
        case IsovalueReason::middle: return "the middle of its range; no isovalue is stable";
    }
    return "";
}

std::string sides_text(const BorderContact& border) {
    std::string text;
    for (unsigned side = 0; side < 6; ++side) {
        if ((border.sides >> side & 1U) == 0) continue;
        if (!text.empty()) text += ' ';
        text += side % 2 == 0 ? '-' : '+';
        text += "xyz"[side / 2];
    }
    return text;
}

std::vector<RecommendedIsovalue> isovalues_of(std::span<const RecommendedIsovalue> isovalues, std::int64_t branch_top) {
    std::vector<RecommendedIsovalue> own;
    std::ranges::copy_if(isovalues, std::back_inserter(own),
                         [&](const RecommendedIsovalue& isovalue) { return isovalue.branch_top == branch_top; });
    return own;
}

std::optional<RecommendedIsovalue> isovalue_of(const ObjectTable& table, const ObjectEntry& entry) {
    const auto own = std::ranges::find_if(table.isovalues, [&](const RecommendedIsovalue& isovalue) {
        return isovalue.branch_top == entry.branch_top.number() && isovalue.tau == entry.best_tau;
    });
    return own == table.isovalues.end() ? std::nullopt : std::optional(*own);
}

namespace {

bool reaches_all_sides(const BorderContact& border, int rank) { return border.sides == (rank == 2 ? 15 : 63); }

bool reaches_all_axes(const BorderContact& border, int rank) {
    for (int axis = 0; axis < rank; ++axis) {
        if ((border.sides >> (2 * axis) & 3U) == 0) return false;
    }
    return true;
}

std::int64_t border_samples(const Extent& extent) {
    std::int64_t inner = 1;
    for (int axis = 0; axis < extent.rank; ++axis) inner *= std::max<std::int64_t>(extent.size[static_cast<std::size_t>(axis)] - 2, 0);
    return extent.voxels() - inner;
}

/// More of its surface lies at the border than does of a cube with three of its six faces there.
bool lies_along_border(const ObjectEntry& entry, const Extent& extent) {
    const BorderContact& border = entry.border;
    if (border.part < kLeastBorderPart || reaches_all_sides(border, extent.rank) || !reaches_all_axes(border, extent.rank)) return false;
    const double half = extent.rank * std::pow(static_cast<double>(entry.voxels), (extent.rank - 1.0) / extent.rank);
    return border.part * static_cast<double>(border_samples(extent)) > half;
}

/// Do other lines show most of it? Lines directly inside one are disjoint.
bool is_shown_by_others(const ObjectTable& table, std::size_t line) {
    std::int64_t shown = 0;
    for (const ObjectEntry& other : table.entries) {
        if (other.inside == static_cast<std::int64_t>(line)) shown += other.voxels;
    }
    return static_cast<double>(shown) >= kShownInside * static_cast<double>(table.entries[line].voxels);
}

}  // namespace

bool is_background(const ObjectTable& table, std::size_t line, const Extent& extent) {
    const ObjectEntry& entry = table.entries[line];
    const bool is_low = entry.border.is_known(), is_around = is_low && reaches_all_sides(entry.border, extent.rank);
    if (is_around && entry.border.part > kBorderPart) return true;
    const bool is_large = static_cast<double>(entry.voxels) > kBackgroundPart * static_cast<double>(extent.voxels());
    if ((entry.outline || is_around) && is_large) return true;
    return is_low && (lies_along_border(entry, extent) || (entry.outline && is_shown_by_others(table, line)));
}

namespace {

template <class Entry>
void keep_first(std::vector<Entry>& entries, std::int64_t top) {
    std::vector<bool> keep(entries.size(), true);
    for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = top <= 0 || static_cast<std::int64_t>(i) < top;
    keep_entries(entries, keep);
}

/// Keeps those of objects that have rows.
void keep_isovalues(std::vector<RecommendedIsovalue>& isovalues, const std::set<std::int64_t>& branches) {
    std::erase_if(isovalues, [&](const RecommendedIsovalue& isovalue) { return !branches.contains(isovalue.branch_top); });
}

std::string inside_text(std::int64_t inside) { return "inside " + std::to_string(inside + 1); }

}  // namespace

ObjectTable first_entries(ObjectTable table, std::int64_t top) {
    keep_first(table.entries, top);
    std::set<std::int64_t> tops;
    for (ObjectEntry& entry : table.entries) {
        entry.note = entry.outline ? "outline" : entry.inside >= 0 ? inside_text(entry.inside) : entry.main_branch ? "largest" : "";
        tops.insert(entry.branch_top.number());
    }
    keep_isovalues(table.isovalues, tops);
    return table;
}

CavityTable first_entries(CavityTable table, std::int64_t top) {
    keep_first(table.entries, top);
    std::set<std::int64_t> minima;
    for (CavityEntry& entry : table.entries) {
        entry.note = entry.inside >= 0 ? inside_text(entry.inside) : "";
        minima.insert(entry.branch_minimum);
    }
    keep_isovalues(table.isovalues, minima);
    return table;
}

}  // namespace isoatlas
