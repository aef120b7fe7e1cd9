// Ids of extrema, and arrays of the engine by element, event and voxel. Number: as narrow as the volume allows.
#pragma once

#include "base/id_array.h"

namespace isoatlas {

template <class Number>
using MaximumIdOf = StrongId<struct MaximumTag, Number>;
/// 0: the outside.
template <class Number>
using MinimumIdOf = StrongId<struct MinimumTag, Number>;

/// Ids of elements ascend downwards; that behind the last element is the outside, where trees have a node for it.
template <class Number, class T>
using ByElement = IdArray<ElementIdOf<Number>, T>;
template <class Number, class T>
using ByElementView = IdSpan<ElementIdOf<Number>, const T>;
template <class Number, class T>
using ByEvent = IdArray<EventIdOf<Number>, T>;
template <class Number, class T>
using ByEventView = IdSpan<EventIdOf<Number>, const T>;
template <class Number, class T>
using ByVoxel = IdArray<VoxelIdOf<Number>, T>;
template <class Number, class T>
using ByVoxelView = IdSpan<VoxelIdOf<Number>, const T>;

/// A join or split tree (tree/merge_tree.h): the parent of every node; a root is its own.
template <class Number>
using MergeTree = ByElement<Number, ElementIdOf<Number>>;
template <class Number>
using MergeTreeView = ByElementView<Number, ElementIdOf<Number>>;

}  // namespace isoatlas
