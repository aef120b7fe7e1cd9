// Query parameters that name objects, as options of the command line do: 2 (number in the table), c3 (cavity), v218663 (voxel); low2,
// lowc3, lowv218663 of low values; each with an isovalue of its own as 2@1367.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue/store_sides.h"
#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"

namespace isoatlas {

class QueryParameters;

/// Throws Error: usage (the store does not hold that polarity).
[[nodiscard]] const Atlas& store_of(const StoreSides& stores, Polarity polarity);

/// The lines of both tables, by number.
struct NumberedLines {
    struct Line {
        std::int64_t voxel;  ///< of the object, or of the contour around the cavity
        double tau;          ///< best isovalue, stored
    };
    std::vector<Line> objects, cavities;
};
[[nodiscard]] NumberedLines numbered_lines(const ObjectTable& objects, const CavityTable& cavities);

/// A store and the lines of its tables, for references.
struct NumberedSides {
    StoreSides stores;
    const NumberedLines& main;
    const NumberedLines* low = nullptr;  ///< of a store that is open for both
    Polarity polarity = Polarity::high;  ///< of references without one

    [[nodiscard]] const NumberedLines& lines(Polarity of) const { return low != nullptr && of == Polarity::low ? *low : main; }
    [[nodiscard]] const Atlas& atlas(Polarity of) const { return stores.of(of); }
};

struct NamedPart {
    bool is_contour = false;
    Polarity polarity = Polarity::high;
    std::int64_t number = 0;  ///< in the table of its side, from 1; 0: in none
    std::int64_t voxel = 0;
    std::optional<double> tau{};  ///< stored; that of the parameter, or the best one of its line
    bool has_own_tau = false;     ///< of the parameter
};

/// "object 2", "cavity 3", "v218663", "object low2"
[[nodiscard]] std::string title_of(const NamedPart& part);

/// Of the parameters `object` and `contour`, in this order, at most `max`. Throws Error: usage (not a reference), not_found (no such
/// number, no such polarity).
[[nodiscard]] std::vector<NamedPart> named_parts(QueryParameters& words, const NumberedSides& sides, std::size_t max);
/// Of one of the two.
[[nodiscard]] std::vector<NamedPart> named_parts(QueryParameters& words, std::string_view name, const NumberedSides& sides,
                                                 std::size_t max);
/// The voxels of parts of a request whose isovalue is a parameter of its own, as its polarity. Throws Error{usage} for one with another
/// isovalue or polarity.
[[nodiscard]] std::vector<std::int64_t> voxels_of(const std::vector<NamedPart>& parts, Polarity polarity);

}  // namespace isoatlas
