// SublevelTree: the tree of low components, rooted at the highest element.
//
// A low component is a connected set of Lows; the one with the outside of the volume is the outside, every other one is a cavity. Going up
// they appear at minima and merge, as objects do going down, and together with the contours around them they are the split tree of the
// contour tree (docs/theory/3-trees.md#join-and-split-tree, docs/theory/4-genus.md#the-contour-tree). So this is not the tree of the
// negated volume: Lows meet where Highs of the same values would not (faces, tunnels), and a Low at the border of the volume lies in the
// outside.
//
// Elements are numbered backwards: the outside is 0, the element x of the contour tree with n elements is n - x. Then heights (values
// negated) descend and children come before their parents, as in the criticality tree, and the same code serves both.
//
// In the literature: split tree, the merge tree of sublevel sets (Carr, Snoeyink, Axen, Computing contour trees in all dimensions, 2003);
// its components are cavities or voids where an object encloses them.
#pragma once

#include "analysis/analysis_data.h"
#include "analysis/object_tree.h"
#include "field/grid.h"
#include "field/order.h"
#include "isoatlas/context.h"
#include "tree/contour_tree.h"
#include "tree/criticality_tree.h"

namespace isoatlas {

/// An event is what happens to one low component at one value; its zone is the isovalues (its value, value of its parent].
template <class Number>
struct SublevelTree {
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;
    CriticalityTree<Number> tree;      ///< elements numbered backwards
    ByEvent<Number, double> height;    ///< value negated; of the outside just above that of the lowest sample
    ByEvent<Number, Number> contours;  ///< around the low component in the zone: to the object around it, and to the objects inside it
    ByEvent<Number, Number> voxels;    ///< of its zone
    ByVoxel<Number, Number> zone;      ///< number of an event, in the memory that basins had

    /// Must live as long as the result. The branch of the outside is the main branch.
    [[nodiscard]] ObjectTree<Number> side() const {
        return {IdSpan<EventId, const Number>(numbers_of<Event>(tree.parent.items())),
                IdSpan<EventId, const double>(height.items()),
                IdSpan<EventId, const Number>(voxels.items()),
                IdSpan<VoxelId, const Number>(zone.items()),
                -1,
                EventId(tree.event_of_element[Element(0)])};
    }
    /// The element of the contour tree behind an event: the lowest of its own.
    [[nodiscard]] Element element(SameKind<Event> auto event) const {
        return Element(tree.event_of_element.size() - 1 - tree.top[event].index());
    }
};

/// arrays: with trees. Cost: O(n alpha) for n elements, and basins and zones of all voxels.
template <class T, class Number>
[[nodiscard]] SublevelTree<Number> make_sublevel_tree(const GridView<T>& grid, const AnalysisArrays<Number>& arrays,
                                                      const Context& context);

/// The same whatever the type of the samples.
template <class Number>
[[nodiscard]] SublevelTree<Number> make_sublevel_tree(const VolumeView& volume, const AnalysisArrays<Number>& arrays,
                                                      const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        return make_sublevel_tree(GridView<T>{samples.data(), volume.info->extent}, arrays, context);
    });
}

/// Voxel of the lowest element of an event; -1: the outside.
template <class Number>
[[nodiscard]] std::int64_t lowest_voxel(const AnalysisArrays<Number>& arrays, const SublevelTree<Number>& sublevel,
                                        SameKind<EventId> auto event) {
    const ElementIdOf<Number> element = sublevel.element(event);
    return element.index() == arrays.code.size() ? -1 : ElementCode{arrays.code[element]}.index();
}

}  // namespace isoatlas
