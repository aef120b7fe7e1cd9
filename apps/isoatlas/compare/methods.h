// The methods that `isoatlas compare` runs: those of the library, and search structures in files.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

/// As method_info.h says it, and how it is chosen.
struct ComparedMethod {
    std::string name{}, title{}, section{}, source{}, cost{};
    bool is_usual = true;  ///< runs unless the user chooses others
    int divisions = 0;     ///< Dividing Cubes: small cubes along each axis of a cell; 0: another method
};

struct ComparedSearch : ComparedMethod {
    /// folder: for files, which are gone when the search is.
    std::function<std::unique_ptr<CellSearch>(const Volume&, const std::string& folder, const Context&)> build;
};

struct ComparedExtractor : ComparedMethod {
    std::function<std::unique_ptr<Extractor>(const Volume&)> make;
    bool is_reference = false;  ///< the trilinear surface
};

struct ComparedMethods {
    std::vector<ComparedExtractor> extractors;  ///< in the order of the dissertation; the reference is the last one
    std::vector<ComparedSearch> searches;       ///< brute force first: it is the reference
};

/// Every method there is.
[[nodiscard]] ComparedMethods all_methods();

/// list: names separated by commas, `surfaces`, `searches`, `all`; empty: the usual ones. Both references run with any other of their kind.
/// Throws Error{usage} for an unknown name.
[[nodiscard]] ComparedMethods chosen_methods(const std::string& list);

}  // namespace isoatlas::cli
