#include "server/store_catalogue.h"

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

}  // namespace

StoreCatalogue load_catalogue(const Atlas& atlas, const Context& context) {
    Overview found = overview_of(atlas, context);
    PageContents contents = page_contents(atlas, found, {}, context);
    (void)atlas.active_index();  // loaded here, so that requests for objects at an isovalue do not wait for it
    const std::vector<OpacityTent> tents =
        propose_transfer(first_entries(std::move(found.objects), kTransferObjects), atlas.info(), atlas.range());
    std::vector<NamedEntry> entries = named_entries(contents);
    std::string json = atlas_json(atlas, contents);
    return {std::move(contents), std::move(found.hierarchy), std::move(entries), std::move(json),
            transfer_json(tents, atlas.info().calibration)};
}

}  // namespace isoatlas
