// Which polarity of the store a request is about, and the objects that it names.
#include "isoatlas/error.h"
#include "server/service.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxObjects = 256;

/// "v1,v2"
bool only_voxels(std::string_view text) {
    while (text.starts_with('v')) {
        const std::size_t comma = text.find(',');
        if (comma == std::string_view::npos) return true;
        text.remove_prefix(comma + 1);
    }
    return false;
}

}  // namespace

const Atlas& Service::atlas(const Request& request) const {
    const StoreSides sides = store_state_.sides();
    return store_of(sides, request.polarity.value_or(polarity_of(sides.main.info())));
}

const SideCatalogue& Service::side_of(const Request& request) { return known(request).of(polarity_of(atlas(request).info())); }

NumberedSides Service::numbered_sides(const Request& request) {
    const StoreCatalogue& known = this->known(request);
    const Polarity polarity = polarity_of(atlas(request).info());
    return {store_state_.sides(), known.main.lines, known.low ? &known.low->lines : nullptr, polarity};
}

const Atlas& Service::atlas_of_volume(const Request& request) const {
    const Atlas& found = atlas(request);
    if (found.info().extent.rank == 3) return found;
    throw Error(ErrorKind::unsupported, {.what = "the contours of a 2D image are not a surface",
                                         .next = "write them into a file without the server",
                                         .reason = Reason::not_in_space});
}

std::vector<std::int64_t> Service::voxels(QueryParameters& words, std::string_view name, const Request& request) {
    static const NumberedLines none;
    const Polarity polarity = polarity_of(atlas(request).info());
    const auto [first, end] = request.words.equal_range(std::string(name));
    // Voxels alone need no tables: the first surface of a page does not wait for them.
    const bool has_numbers = first != end && !only_voxels(first->second);
    const NumberedSides sides = has_numbers ? numbered_sides(request) : NumberedSides{store_state_.sides(), none, nullptr, polarity};
    return voxels_of(named_parts(words, name, sides, kMaxObjects), polarity);
}

}  // namespace isoatlas
