#include "catalogue/page_contents.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "atlas/access.h"
#include "base/cancel.h"
#include "catalogue/draw_cards.h"
#include "catalogue/page_axis.h"
#include "catalogue/page_draft.h"
#include "catalogue/thin_curve.h"
#include "census/count_intervals.h"
#include "isoatlas/cards.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kColumns = 480;       // of the spectrum
constexpr std::int64_t kShapeColumns = 120;  // of one object
constexpr std::int64_t kOthers = 200;        // branches without a picture
constexpr std::int64_t kCurvePoints = 160;

class Gatherer {
public:
    Gatherer(const Atlas& atlas, const Overview& found, const PageOptions& options, const Context& context)
        : atlas_(atlas),
          polarity_(polarity_of(atlas.info())),
          options_(options),
          context_(context),
          found_(found),
          analysis_(AtlasAccess::analysis(atlas)),
          hierarchy_(found_.hierarchy),
          branch_of_event_(static_cast<std::size_t>(analysis_.event_count()), -1) {}

    PageContents gather() && {
        const double low = atlas_.range()[0];
        contents_.scale = page_axis(atlas_, context_);
        stop_if_cancelled(context_);
        contents_.spectrum = count_columns(count_intervals(analysis_, found_.objects), low, contents_.scale, kColumns);
        const ObjectTable table = first_entries(found_.objects, options_.top);
        CavityTable cavities = found_.cavities;
        contents_.objects = table.branches, contents_.noise = table.noise;
        contents_.significant_objects = static_cast<std::int64_t>(hierarchy_.significant().size());
        contents_.cavities = cavities.branches, contents_.significant_cavities = static_cast<std::int64_t>(cavities.entries.size());
        if (static_cast<std::int64_t>(cavities.entries.size()) > options_.top_cavities)
            cavities.entries.resize(static_cast<std::size_t>(options_.top_cavities));
        add_object_branches(table);
        add_object_entries(table);
        add_cavities(cavities);
        stop_if_cancelled(context_);
        contents_.histogram = make_histogram(atlas_, contents_.scale, context_);
        contents_.curve = thin_curve(hierarchy_.curves().front(), kCurvePoints);
        for (PageEntry& entry : contents_.entries) finish(entry);
        return std::move(contents_);
    }

private:
    void finish(PageEntry& entry) const {
        const bool is_cavity = contents_.branches[entry.branch].is_cavity, is_low = polarity_ == Polarity::low;
        entry.colour = is_cavity != is_low ? colour_of_cavity(entry.number) : colour_of_object(entry.number);
        const ObjectName* name = find_object_name(options_.names, is_cavity, entry.id, atlas_.info().calibration.reported(entry.tau));
        if (name != nullptr) entry.name = name->name;
    }

    /// Branches of the table, and the first ones by rank.
    void add_object_branches(const ObjectTable& table) {
        const std::span<const BranchInfo> all = hierarchy_.branches();
        std::vector<bool> is_significant(all.size(), false);
        for (const BranchId i : hierarchy_.significant()) is_significant[i.index()] = true;
        std::unordered_set<EventId> shown;
        for (const ObjectEntry& entry : table.entries) shown.insert(entry.branch_top);
        std::vector<std::int64_t> joined(all.size(), 0);
        for (const BranchInfo& b : all) {
            if (b.parent.exists()) ++joined[b.parent.index()];
        }
        std::vector<std::int64_t> place(all.size(), -1);
        std::int64_t others = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const BranchInfo& b = all[i];
            const bool is_shown = shown.contains(b.top);
            if (!is_shown && (i > 0 && others++ >= kOthers)) continue;
            place[i] = static_cast<std::int64_t>(contents_.branches.size());
            place_of_top_.emplace(b.top, place[i]);
            contents_.branches.push_back({.polarity = polarity_,
                                          .id = b.id,
                                          .number = 0,
                                          .rank = static_cast<std::int64_t>(i),
                                          .appears = b.appears,
                                          .merges = b.merges,
                                          .parent = b.parent.number(),
                                          .hypervolume = b.hypervolume,
                                          .voxels = b.voxels,
                                          .measure = b.measure,
                                          .joined = joined[i],
                                          .is_significant = is_significant[i],
                                          .shape = is_shown ? shape_of(b) : std::vector<CountColumn>{},
                                          .top = b.top});
            if (!is_shown) continue;
            for (const EventId event : events_of(analysis_, b.top, b.merges)) branch_of_event_[event.index()] = place[i];
        }
        number_branches();
        for (PageBranch& b : contents_.branches) {
            while (b.parent >= 0 && place[b.parent] < 0) b.parent = all[b.parent].parent.number();
            if (b.parent >= 0) b.parent = place[b.parent];
        }
    }
    /// By their first entries.
    void number_branches() {
        const std::vector<ObjectEntry>& entries = found_.objects.entries;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const auto place = place_of_top_.find(entries[i].branch_top);
            if (place == place_of_top_.end()) continue;
            PageBranch& branch = contents_.branches[static_cast<std::size_t>(place->second)];
            if (branch.number == 0) branch.number = static_cast<std::int64_t>(i) + 1;
        }
    }
    std::vector<CountColumn> shape_of(const BranchInfo& b) const {
        const std::vector<SpectrumInterval> intervals = branch_intervals(analysis_, b.top, b.merges);
        return count_columns(intervals, std::max(atlas_.range()[0], b.merges), contents_.scale, kShapeColumns);
    }

    void add_object_entries(const ObjectTable& table) {
        const std::vector<Card> cards = cards_of(table, atlas_.info().extent);
        for (const ObjectEntry& entry : table.entries) {
            const Card& card = cards[static_cast<std::size_t>(&entry - table.entries.data())];
            contents_.entries.push_back({.branch = place_of_top_.at(entry.branch_top),
                                         .number = std::ssize(contents_.entries) + 1,
                                         .id = entry.id,
                                         .tau = entry.best_tau,
                                         .tau_low = std::max(entry.tau_low, atlas_.range()[0]),
                                         .tau_high = entry.tau_high,
                                         .voxels = entry.voxels,
                                         .measure = entry.measure,
                                         .tunnels = entry.tunnels,
                                         .cavities = entry.cavities,
                                         .inside = entry.inside,
                                         .reason = reason_of(table, entry),
                                         .card = static_cast<std::int64_t>(card.line) + 1,
                                         .overlap = card.overlap,
                                         .is_background = card.is_background});
        }
        for (const RecommendedIsovalue& isovalue : table.isovalues) {
            const std::int64_t branch = place_of_top_.at(EventId(isovalue.branch_top));
            const bool is_shown = std::ranges::any_of(
                contents_.entries, [&](const PageEntry& entry) { return entry.branch == branch && entry.tau == isovalue.tau; });
            if (!is_shown) contents_.branches[branch].isovalues.push_back(isovalue);
        }
    }
    static std::optional<IsovalueReason> reason_of(const ObjectTable& table, const ObjectEntry& entry) {
        const std::optional<RecommendedIsovalue> isovalue = isovalue_of(table, entry);
        return isovalue ? std::optional(isovalue->reason) : std::nullopt;
    }

    /// A cavity merges into the one around it, or into the outside.
    void add_cavities(const CavityTable& cavities) {
        const auto first_branch = static_cast<std::int64_t>(contents_.branches.size());
        const auto first_entry = static_cast<std::int64_t>(contents_.entries.size());
        for (const CavityEntry& entry : cavities.entries) {
            const std::int64_t inside = entry.inside < static_cast<std::int64_t>(cavities.entries.size()) ? entry.inside : -1;
            const auto branch = static_cast<std::int64_t>(contents_.branches.size());
            contents_.branches.push_back({.is_cavity = true,
                                          .polarity = polarity_,
                                          .id = entry.id,
                                          .number = branch - first_branch + 1,
                                          .rank = branch - first_branch,
                                          .appears = entry.appears,
                                          .merges = entry.merges,
                                          .parent = inside < 0 ? -1 : first_branch + inside,
                                          .hypervolume = entry.hypervolume,
                                          .voxels = entry.voxels,
                                          .measure = entry.measure,
                                          .is_significant = true,
                                          .isovalues = isovalues_of(cavities.isovalues, entry.branch_minimum)});
            std::erase_if(contents_.branches.back().isovalues,
                          [&](const RecommendedIsovalue& isovalue) { return isovalue.tau == entry.best_tau; });
            contents_.entries.push_back({.branch = branch,
                                         .number = branch - first_branch + 1,
                                         .id = entry.id,
                                         .tau = entry.best_tau,
                                         .tau_low = entry.tau_low,
                                         .tau_high = std::min(entry.tau_high, atlas_.range()[1]),
                                         .voxels = entry.voxels,
                                         .measure = entry.measure,
                                         .tunnels = entry.tunnels,
                                         .cavities = entry.islands,
                                         .inside = inside < 0 ? -1 : first_entry + inside,
                                         .around = entry_around(entry),
                                         .reason = entry.reason,
                                         .card = branch - first_branch + 1});
        }
    }
    /// The entry of the surrounding object, of several the one with the closest isovalue; -1: that object has none.
    std::int64_t entry_around(const CavityEntry& cavity) const {
        const ActiveObjects there = atlas_.active(cavity.best_tau, false);
        const auto object = std::ranges::find(there.objects, cavity.object, &ActiveObject::id);
        if (object == there.objects.end()) return -1;
        const std::int64_t branch = branch_of_event_[object->event.index()];
        std::int64_t closest = -1;
        double distance = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < contents_.entries.size(); ++i) {
            const PageEntry& entry = contents_.entries[i];
            if (entry.branch != branch || std::abs(entry.tau - cavity.best_tau) >= distance) continue;
            closest = static_cast<std::int64_t>(i);
            distance = std::abs(entry.tau - cavity.best_tau);
        }
        return closest;
    }

    const Atlas& atlas_;
    const Polarity polarity_;
    const PageOptions& options_;
    const Context& context_;
    const Overview& found_;
    const Analysis& analysis_;
    const BranchHierarchy& hierarchy_;
    std::unordered_map<EventId, std::int64_t> place_of_top_;
    std::vector<std::int64_t> branch_of_event_;  ///< -1: of a branch without an entry
    PageContents contents_;
};

}  // namespace

PageContents page_contents(const Atlas& atlas, const Overview& found, const PageOptions& options, const Context& context) {
    return Gatherer(atlas, found, options, context).gather();
}

Surface surface_of(const Atlas& atlas, bool is_cavity, const PageEntry& entry, const Context& context) {
    SurfaceOptions chosen;
    (is_cavity ? chosen.contours : chosen.objects) = {entry.id};
    return atlas.extract(entry.tau, chosen, context);
}

namespace {

Surface surface_of(const PageContents& contents, const StoreSides& sides, std::size_t i, const Context& context) {
    const PageEntry& entry = contents.entries[i];
    const PageBranch& branch = contents.branches[entry.branch];
    return surface_of(sides.of(branch.polarity), branch.is_cavity, entry, context);
}

PictureKey key_of(const PageEntry& entry) { return {entry.id, entry.tau, entry.number}; }

/// Of every entry: what the draft has, if there is one.
std::vector<std::optional<CardPicture>> drawn_before(const PageContents& contents, PageDraft* draft) {
    std::vector<std::optional<CardPicture>> cards(contents.entries.size());
    if (draft == nullptr) return cards;
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const PageBranch& branch = contents.branches[contents.entries[i].branch];
        if (branch.is_cavity || branch.polarity == Polarity::low) continue;
        auto kept = draft->data().cards.extract(key_of(contents.entries[i]));
        if (!kept.empty()) cards[i] = std::move(kept.mapped());
    }
    return cards;
}

/// Of a 2D volume: slices with the contours.
void draw_slices(PageContents& contents, const StoreSides& sides, const PageOptions& options, const Context& context) {
    Context silent = context;
    silent.progress = nullptr;
    std::optional<Volume> image;
    for (PageEntry& entry : contents.entries) {
        stop_if_cancelled(context);
        const Atlas& atlas = sides.of(contents.branches[entry.branch].polarity);
        if (!image || polarity_of(image->info) != polarity_of(atlas.info())) image = atlas.volume(silent);
        entry.picture = draw_still(*image, entry.tau, entry.colour, options, silent);
    }
}

}  // namespace

void draw_first_pictures(PageContents& contents, const Atlas& atlas, const PageOptions& options, PageDraft::Data& draft,
                         const Context& context) {
    std::vector<CardPicture> cards(std::min(kFirstCards, contents.entries.size()));
    const auto draw = [&](std::size_t i, const Context& own) {
        const PageEntry& entry = contents.entries[i];
        cards[i] = draw_card(surface_of(atlas, false, entry, own), entry.colour, options, own);
    };
    draw_cards(cards.size(), draw, [](std::size_t) {}, context);
    for (std::size_t i = 0; i < cards.size(); ++i) {
        PageEntry& entry = contents.entries[i];
        entry.picture = cards[i].picture;
        draft.cards.emplace(key_of(entry), std::move(cards[i]));
    }
}

std::vector<std::optional<CoarseSurface>> draw_pictures(PageContents& contents, const StoreSides& sides, const PageOptions& options,
                                                        const std::function<void(std::size_t)>& drawn, const Context& context) {
    if (sides.main.info().extent.rank == 2) {
        draw_slices(contents, sides, options, context);
        return {};
    }
    std::vector<std::optional<CoarseSurface>> coarse(contents.entries.size());
    std::vector<std::optional<CardPicture>> before = drawn_before(contents, options.draft);
    const auto draw = [&](std::size_t i, const Context& own) {
        PageEntry& entry = contents.entries[i];
        std::optional<CardPicture>& card = before[i];
        if (!card) card = draw_card(surface_of(contents, sides, i, own), entry.colour, options, own);
        entry.picture = std::move(card->picture);
        coarse[i] = std::move(card->coarse);
    };
    draw_cards(coarse.size(), draw, drawn, context);
    return coarse;
}

std::vector<CoarseSurface> coarse_surfaces(const PageContents& contents, const StoreSides& sides,
                                           std::vector<std::optional<CoarseSurface>> made, const Context& context) {
    const auto surface = [&](std::size_t i, const Context& own) { return surface_of(contents, sides, i, own); };
    return coarse_cards(std::move(made), surface, context);
}

}  // namespace isoatlas
