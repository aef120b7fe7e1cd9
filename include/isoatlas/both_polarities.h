// Objects of high and of low values in one ranked list.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"
#include "isoatlas/polarity.h"

namespace isoatlas {

/// An entry of one of two tables in the list of both.
struct RankedObject {
    Polarity polarity;
    std::size_t entry;            ///< position in ObjectTable::entries of its polarity
    std::int64_t inside = -1;     ///< position in the list of the closest entry of the same polarity that contains it; -1: none
    std::int64_t cavity_of = -1;  ///< position in the list of the object of high values that encloses this one of low values; -1: none
    bool is_enclosed = false;     ///< of low values, and does not reach the border: a cavity of some object
    std::string note;             ///< "largest", "inside 3", "cavity of 2", "reaches the border at -x +y (3 % of it)", ...
};

struct TogetherOptions {
    std::int64_t top = 0;  ///< at most this many entries; 0: all
    /// Does an object of low values, at its best isovalue, hold a voxel? It is asked with the lowest voxels of cavities, to find which of
    /// them an enclosed object is. None: only cavities with the same lowest voxel are found, which plateaus hide.
    std::function<bool(const ObjectEntry& low, std::int64_t voxel)> holds{};
};

/// Of each entry: sum over the object of its contrast, in the unit of the values times voxels. Above `merges`, ObjectEntry::hypervolume; of
/// the main branch, which never merges, above best_tau, with voxels falling along straight lines between its entries.
[[nodiscard]] std::vector<double> hypervolumes_of_lines(const ObjectTable& table);

/// The entries of the tables of a volume and of the negated one (isoatlas/polarity.h), by hypervolumes_of_lines(): contrast times size,
/// which means the same on both sides (docs/theory/9-low-values.md#one-list). Entries on one card (isoatlas/cards.h) stay together, in the
/// order of their table; background (is_background()) comes last. high: the cavities of the volume, too; those that are objects of low
/// values of the list say what they are cavities of. Cost: O(entries log entries), and of each enclosed object options.holds() for
/// cavities by rank until it is found.
[[nodiscard]] std::vector<RankedObject> rank_together(const ObjectsAndCavities& high, const ObjectTable& low, const Extent& extent,
                                                      const TogetherOptions& options = {});

/// "reaches the border at -x +y (3 % of it)", "reaches the border on all sides (80 % of it)"; "": it does not, or that is unknown.
[[nodiscard]] std::string border_text(const BorderContact& border, const Extent& extent);

}  // namespace isoatlas
