// The text tables of named cases. A new case needs no compiler: add lines to a .txt file in tests/cases.
//
//   case NAME                      starts a case; the name is one word
//   dims NX NY [NZ]                two numbers: a 2D volume
//   values V V ...                 x fastest; may be repeated, the numbers add up
//   border V                       puts one layer of V around the values
//   elements N | levels N | events N | maxima N     counts of the analysis
//   level V in G ... out G ...     this level exists (genera sorted)
//   event V KIND DCHI              this event exists; KIND as in the tree output, "genus change" is written genus
//   at TAU objects N chi C genera G ...   what a cut finds: C summed over the objects, genera of all contours (2D: 0s), sorted
//   faces ... | trilinear ...      the line is true for this interpolant only
//   # ...                          a comment
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "oracle/oracle.h"

namespace oracle {

struct Expectation {
    std::optional<isoatlas::Interpolant> interpolant;  ///< none: holds for both
    std::string what;                                  ///< "elements", "level", "event", "at", ...
    double value = 0;                                  ///< count, isovalue or tau
    std::string kind;                                  ///< of an event
    std::vector<Index> first, second;                  ///< level: in, out; event: {delta_chi}; at: {objects, chi}, genera
    int line = 0;
};

struct NamedCase {
    std::string file, name;
    int line = 0;
    Grid grid;
    std::vector<Expectation> expectations;
};

inline void PrintTo(const NamedCase& c, std::ostream* out) { *out << c.file << ':' << c.line; }

/// All cases of the *.txt files of a folder, by file and line. Throws std::runtime_error("FILE:LINE: ...") for a line it does not know.
std::vector<NamedCase> read_cases(const std::string& folder);

}  // namespace oracle
