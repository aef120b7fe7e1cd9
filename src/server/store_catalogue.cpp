#include "server/store_catalogue.h"

#include <map>

#include "atlas/overview.h"
#include "catalogue/joined_contents.h"
#include "isoatlas/render.h"
#include "server/answers.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kTransferObjects = 5;  ///< as `isoatlas render --volume`

std::vector<NamedEntry> named_entries(const PageContents& contents) {
    std::vector<NamedEntry> entries;
    for (const PageEntry& entry : contents.entries) {
        const PageBranch& branch = contents.branches[static_cast<std::size_t>(entry.branch)];
        entries.push_back({entry.id, entry.tau, entry.voxels, branch.is_cavity, branch.polarity});
    }
    return entries;
}

std::vector<std::int64_t> number_of_rank(const Overview& found) {
    std::map<EventId, std::int64_t> of_top;
    for (const ObjectEntry& entry : found.objects.entries) of_top.emplace(entry.branch_top, &entry - found.objects.entries.data() + 1);
    std::vector<std::int64_t> numbers;
    for (const BranchInfo& branch : found.hierarchy.branches()) {
        const auto number = of_top.find(branch.top);
        numbers.push_back(number == of_top.end() ? 0 : number->second);
    }
    return numbers;
}

SideCatalogue side_of(const Atlas& atlas, Overview found) {
    (void)atlas.active_index();  // loaded here, so that requests for objects at an isovalue do not wait for it
    NumberedLines lines = numbered_lines(found.objects, found.cavities);
    std::vector<std::int64_t> numbers = number_of_rank(found);
    const std::vector<OpacityTent> tents =
        propose_transfer(first_entries(std::move(found.objects), kTransferObjects), atlas.info(), atlas.range());
    return {std::move(found.hierarchy), std::move(lines), std::move(numbers), transfer_json(tents, atlas.info().calibration)};
}

}  // namespace

StoreCatalogue load_catalogue(const StoreSides& sides, const Context& context) {
    Overview found = overview_of(sides.main, context);
    if (!sides.has_both()) {
        PageContents contents = page_contents(sides.main, found, {}, context);
        std::vector<NamedEntry> entries = named_entries(contents);
        std::string json = atlas_json(sides, contents);
        return {std::move(contents), std::move(entries), std::move(json), side_of(sides.main, std::move(found)), std::nullopt};
    }
    Overview low = overview_of(*sides.low, context);
    PageContents contents = joined_contents(sides, found, low, {}, context);
    std::vector<NamedEntry> entries = named_entries(contents);
    std::string json = atlas_json(sides, contents);
    return {std::move(contents), std::move(entries), std::move(json), side_of(sides.main, std::move(found)),
            side_of(*sides.low, std::move(low))};
}

}  // namespace isoatlas
