#include "features/cavity_candidates.h"

namespace isoatlas {

template <class Id>
CavityCandidates<Id> make_cavity_candidates(const VolumeView& volume, const AnalysisArrays<Id>& arrays, const NoiseModel& noise,
                                            const RankOptions& options, const Context& context) {
    CavityCandidates<Id> side;
    side.sublevel = make_sublevel_tree(volume, arrays, context);
    side.tree = side.sublevel.side();  // its spans stay where they are when the side moves
    side.branches = decompose_branches(side.tree, sum_zones(side.tree, volume));
    RankOptions with_outside = options;
    with_outside.top = 0;
    if (with_outside.selection && with_outside.selection->keep) ++*with_outside.selection->keep;
    side.chosen = find_candidates(volume, side.tree, side.branches, noise, with_outside);
    const auto is_outside = [](const auto& part) { return part.branch == kMainBranch; };
    std::erase_if(side.chosen.rows, is_outside);
    std::erase_if(side.chosen.isovalues, is_outside);
    std::erase_if(side.chosen.histograms, is_outside);
    return side;
}

template CavityCandidates<std::uint32_t> make_cavity_candidates(const VolumeView&, const AnalysisArrays<std::uint32_t>&, const NoiseModel&,
                                                                const RankOptions&, const Context&);
template CavityCandidates<std::uint64_t> make_cavity_candidates(const VolumeView&, const AnalysisArrays<std::uint64_t>&, const NoiseModel&,
                                                                const RankOptions&, const Context&);

}  // namespace isoatlas
