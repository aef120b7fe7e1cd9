// Which part of the border of the volume each entry of a table of objects takes.
#pragma once

#include <vector>

#include "analysis/object_tree.h"
#include "isoatlas/objects.h"

namespace isoatlas {

/// Sets ObjectEntry::border of all entries. tree: of the superlevel sets of this volume, with zones. Cost: O(events), and for every sample
/// at the border the number of entries that are nested there.
template <class Id>
void add_border_contacts(const VolumeView& volume, const ObjectTree<Id>& tree, std::vector<ObjectEntry>& entries);

}  // namespace isoatlas
