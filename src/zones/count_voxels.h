// Voxels per critical element; sizes of zones are sums of them.
//
// A voxel belongs to the lowest element on the way down the join tree from the voxel that is not below the voxel's value. The voxels of a
// zone are those of the elements of its event (tree/criticality_tree.h): values between two elements of an object belong to the upper one.
#pragma once

#include <cstdint>
#include <span>

#include "field/grid.h"
#include "isoatlas/context.h"
#include "tree/contour_tree.h"

namespace isoatlas {

/// Does the memory limit leave room for the paths of so many elements, which are accessed at random?
[[nodiscard]] bool paths_fit(std::size_t elements);

/// With the tree. value, code: of all elements; contours: their arcs. basin_to_element: basins of critical/elements_with_extrema.h, which
/// the element takes the place of that the voxel belongs to. Cost: O(n alpha + voxels), about 30 bytes an element.
template <class T, class Number>
[[nodiscard]] ByElement<Number, Number> voxels_by_paths(const GridView<T>& grid, ByElementView<Number, double> value,
                                                        ByElementView<Number, std::uint64_t> code, const ContourTree<Number>& contours,
                                                        std::span<Number> basin_to_element, const Context& context);

/// The same without a tree: works on one tile a thread at a time, and on what spans tiles in descending order.
/// Cost: O(n alpha + voxels log(voxels of a tile)).
template <class T, class Number>
[[nodiscard]] ByElement<Number, Number> voxels_by_tiles(const GridView<T>& grid, ByElementView<Number, double> value,
                                                        ByElementView<Number, std::uint64_t> code, const Context& context);

}  // namespace isoatlas
