// The first entries of a table of objects, their notes there, and texts for the reasons of their isovalues.
#include <algorithm>
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

bool is_background(const ObjectEntry& entry, const Extent& extent) {
    const bool is_around = entry.border.is_known() && entry.border.sides == (extent.rank == 2 ? 15 : 63);
    if (is_around && entry.border.part > kBorderPart) return true;
    return (entry.outline || is_around) && static_cast<double>(entry.voxels) > kBackgroundPart * static_cast<double>(extent.voxels());
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
