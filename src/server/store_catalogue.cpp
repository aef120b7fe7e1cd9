#include "server/store_catalogue.h"

#include <map>

#include "atlas/overview.h"
#include "isoatlas/render.h"
#include "server/answers.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kTransferObjects = 5;  ///< as `isoatlas render --volume`

std::vector<NamedEntry> named_entries(const PageContents& contents) {
    std::vector<NamedEntry> entries;
    for (const PageEntry& entry : contents.entries) {
        const bool is_cavity = contents.branches[static_cast<std::size_t>(entry.branch)].is_cavity;
        entries.push_back({entry.id, entry.tau, entry.voxels, is_cavity});
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

}  // namespace

StoreCatalogue load_catalogue(const Atlas& atlas, const Context& context) {
    Overview found = overview_of(atlas, context);
    PageContents contents = page_contents(atlas, found, {}, context);
    (void)atlas.active_index();  // loaded here, so that requests for objects at an isovalue do not wait for it
    NumberedLines lines = numbered_lines(found.objects, found.cavities);
    std::vector<std::int64_t> numbers = number_of_rank(found);
    const std::vector<OpacityTent> tents =
        propose_transfer(first_entries(std::move(found.objects), kTransferObjects), atlas.info(), atlas.range());
    std::vector<NamedEntry> entries = named_entries(contents);
    std::string json = atlas_json(atlas, contents);
    return {std::move(contents),
            std::move(found.hierarchy),
            std::move(entries),
            std::move(lines),
            std::move(numbers),
            std::move(json),
            transfer_json(tents, atlas.info().calibration)};
}

}  // namespace isoatlas
