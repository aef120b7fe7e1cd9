#include "features/dark_side.h"

namespace isoatlas {

template <class Id>
DarkSide<Id> make_dark_side(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const NoiseModel& noise, const RankOptions& options,
                            const Context& context) {
    DarkSide<Id> side;
    side.dark = make_dark_tree(volume, arrays, context);
    side.tree = side.dark.side();  // its spans stay where they are when the side moves
    side.branches = make_branches(side.tree, sum_zones(side.tree, volume));
    RankOptions with_outside = options;
    with_outside.top = 0;
    if (with_outside.selection && with_outside.selection->keep) ++*with_outside.selection->keep;
    side.chosen = branch_rows(volume, side.tree, side.branches, noise, with_outside);
    const auto is_outside = [](const auto& part) { return part.branch == 0; };
    std::erase_if(side.chosen.rows, is_outside);
    std::erase_if(side.chosen.isovalues, is_outside);
    std::erase_if(side.chosen.histograms, is_outside);
    return side;
}

template DarkSide<std::uint32_t> make_dark_side(const VolumeView&, const AnalysisArrays<std::uint32_t>&, const NoiseModel&,
                                                const RankOptions&, const Context&);
template DarkSide<std::uint64_t> make_dark_side(const VolumeView&, const AnalysisArrays<std::uint64_t>&, const NoiseModel&,
                                                const RankOptions&, const Context&);

}  // namespace isoatlas
