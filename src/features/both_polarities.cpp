#include "isoatlas/both_polarities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "isoatlas/cards.h"

namespace isoatlas {
namespace {

/// Entries on one card, and its rank.
struct PolarGroup {
    Polarity polarity;
    double hypervolume;
    std::vector<std::size_t> entries;
};

std::vector<PolarGroup> groups_of(const ObjectTable& table, Polarity polarity, const Extent& extent) {
    const std::vector<Card> cards = cards_of(table, extent);
    const std::vector<double> hypervolumes = hypervolumes_of_lines(table);
    std::vector<PolarGroup> groups;
    std::map<std::size_t, std::size_t> of_card;
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const auto [at, is_new] = of_card.emplace(cards[i].line, groups.size());
        if (is_new) groups.push_back({polarity, 0, {}});
        PolarGroup& group = groups[at->second];
        group.entries.push_back(i);
        group.hypervolume = std::max(group.hypervolume, hypervolumes[i]);
    }
    return groups;
}

class List {
public:
    List(const ObjectsAndCavities& high, const ObjectTable& low, const Extent& extent, const TogetherOptions& options)
        : high_(high), low_(low), extent_(extent), options_(options) {
        std::vector<PolarGroup> groups = groups_of(high.objects, Polarity::high, extent);
        std::ranges::move(groups_of(low, Polarity::low, extent), std::back_inserter(groups));
        std::ranges::stable_sort(groups, std::ranges::greater(), &PolarGroup::hypervolume);
        for (const bool background : {false, true}) {
            for (const PolarGroup& group : groups) {
                for (const std::size_t i : group.entries) {
                    if (is_background(table(group.polarity), i, extent) == background)
                        list_.push_back({group.polarity, i, -1, -1, false, ""});
                }
            }
        }
    }

    std::vector<RankedObject> take() && {
        const std::int64_t top = options_.top;
        if (top > 0 && std::ssize(list_) > top) list_.resize(static_cast<std::size_t>(top));
        for (std::size_t i = 0; i < list_.size(); ++i) place_[{list_[i].polarity, list_[i].entry}] = static_cast<std::int64_t>(i);
        for (RankedObject& object : list_) describe(object);
        return std::move(list_);
    }

private:
    [[nodiscard]] const ObjectTable& table(Polarity polarity) const { return polarity == Polarity::high ? high_.objects : low_; }
    [[nodiscard]] const ObjectEntry& entry(const RankedObject& object) const { return table(object.polarity).entries[object.entry]; }
    [[nodiscard]] std::int64_t place_of(Polarity polarity, std::int64_t entry) const {
        const auto found = place_.find({polarity, static_cast<std::size_t>(entry)});
        return found == place_.end() ? -1 : found->second;
    }

    void describe(RankedObject& object) const {
        const ObjectEntry& own = entry(object);
        std::int64_t around = own.inside;  // of those that are listed
        while (around >= 0 && place_of(object.polarity, around) < 0)
            around = table(object.polarity).entries[static_cast<std::size_t>(around)].inside;
        if (around >= 0) object.inside = place_of(object.polarity, around);
        const auto add = [&object](const std::string& text) {
            if (!text.empty()) object.note += (object.note.empty() ? "" : ", ") + text;
        };
        if (own.outline) {
            add("outline");
        } else if (object.inside >= 0) {
            add("inside " + std::to_string(object.inside + 1));
        } else if (own.main_branch) {
            add("largest");
        }
        if (object.polarity == Polarity::high) return;
        object.is_enclosed = own.border.is_known() && own.border.sides == 0;
        if (object.is_enclosed) {
            object.cavity_of = enclosing(own);
            add(object.cavity_of >= 0 ? "cavity of " + std::to_string(object.cavity_of + 1) : "cavity");
        }
        add(border_text(own.border, extent_));
    }

    /// The listed entry of the object around a cavity whose isovalue is closest; background only if there is no other one.
    [[nodiscard]] std::int64_t enclosing(const ObjectEntry& low) const {
        const std::vector<CavityEntry>& cavities = high_.cavities.entries;
        const auto cavity = std::ranges::find_if(
            cavities, [&](const CavityEntry& c) { return c.id == low.id || (options_.holds && options_.holds(low, c.id)); });
        if (cavity == cavities.end()) return -1;
        std::int64_t closest = -1;
        std::pair<bool, double> least{true, std::numeric_limits<double>::infinity()};
        for (std::size_t i = 0; i < list_.size(); ++i) {
            const ObjectEntry& high = entry(list_[i]);
            if (list_[i].polarity == Polarity::low || high.id != cavity->object) continue;
            const std::pair<bool, double> away{is_background(high_.objects, list_[i].entry, extent_),
                                               std::abs(high.best_tau - cavity->best_tau)};
            if (away < least) closest = static_cast<std::int64_t>(i), least = away;
        }
        return closest;
    }

    const ObjectsAndCavities& high_;
    const ObjectTable& low_;
    const Extent& extent_;
    const TogetherOptions& options_;
    std::vector<RankedObject> list_;
    std::map<std::pair<Polarity, std::size_t>, std::int64_t> place_;
};

}  // namespace

std::vector<double> hypervolumes_of_lines(const ObjectTable& table) {
    std::vector<double> result(table.entries.size());
    std::vector<std::size_t> lines;  // of the main branch, from the inside out
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = table.entries[i].hypervolume;
        if (table.entries[i].main_branch) lines.push_back(i);
    }
    std::ranges::stable_sort(lines, {}, [&](std::size_t i) { return table.entries[i].voxels; });
    double tau = lines.empty() ? 0 : table.entries[lines.front()].appears, voxels = 0, sum = 0;
    for (const std::size_t i : lines) {
        const ObjectEntry& line = table.entries[i];
        sum += std::abs(line.best_tau - tau) * std::midpoint(voxels, static_cast<double>(line.voxels));
        tau = line.best_tau, voxels = static_cast<double>(line.voxels);
        result[i] = sum;
    }
    return result;
}

std::vector<RankedObject> rank_together(const ObjectsAndCavities& high, const ObjectTable& low, const Extent& extent,
                                        const TogetherOptions& options) {
    return List(high, low, extent, options).take();
}

std::string border_text(const BorderContact& border, const Extent& extent) {
    if (!border.is_known() || border.sides == 0) return "";
    const bool is_all = border.sides == (extent.rank == 2 ? 15 : 63);
    const double percent = 100 * border.part;
    const std::string part = percent < 1 ? "less than 1" : std::to_string(std::lround(percent));
    return "reaches the border " + (is_all ? "on all sides" : "at " + sides_text(border)) + " (" + part + " % of it)";
}

}  // namespace isoatlas
