#include "atlas/census_arrays.h"

#include <algorithm>

#include "census/level_census.h"
#include "store/container.h"
#include "store/pack.h"

namespace isoatlas {
namespace {

template <class Census, class Visit>
void for_counts(Census& census, Visit&& visit) {
    visit("census/samples", census.samples);
    visit("census/cells_high", census.cells_high);
    visit("census/cells_low", census.cells_low);
    visit("census/hits_high", census.hits_high);
    visit("census/hits_low", census.hits_low);
}

}  // namespace

std::vector<PackedArray> census_arrays(const LevelCensus& census) {
    std::vector<PackedArray> arrays{packed<double>("census/value", "float64", census.value)};
    for_counts(census, [&](const char* name, const std::vector<std::uint64_t>& counts) {
        arrays.push_back(packed<std::uint64_t>(name, "uint64", counts));
    });
    return arrays;
}

LevelCensus census_of(const Container& store) {
    LevelCensus census;
    census.value = store.all<double>("census/value", "float64");
    bool is_sound = !census.value.empty() && std::is_sorted(census.value.begin(), census.value.end());
    const auto max = static_cast<std::uint64_t>(64 * store.contents().volume.extent.voxels());
    for_counts(census, [&](const char* name, std::vector<std::uint64_t>& counts) {
        counts = store.all<std::uint64_t>(name, "uint64");
        is_sound = is_sound && counts.size() == census.value.size() && std::is_sorted(counts.rbegin(), counts.rend()) && counts[0] <= max;
    });
    if (is_sound) return census;
    throw Error(ErrorKind::input, {.file = store.path(),
                                   .where = "census",
                                   .what = "its numbers are inconsistent",
                                   .next = "the store is damaged: build it again from the volume"});
}

}  // namespace isoatlas
