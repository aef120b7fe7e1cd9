// The surface of one cell as loops of hits (Spider Web, docs/theory/5-surfaces.md#spider-web).
//
// A hit is an edge 0..11 whose corners differ. Each face links its hits in pairs; the links close to loops; one disk per loop is the
// surface. Loops are directed: seen from outside the cell the Highs lie to the right of every link, so a disk spanned by a loop is
// counter-clockwise seen from the Lows (in right-handed index coordinates). A case is a High pattern together with the joined bits of its
// split faces: 656 cases in all.
//
// In the literature: the cases of Marching Cubes (Lorensen, Cline 1987) with their ambiguous faces resolved.
#pragma once

#include <array>
#include <cstdint>

#include "field/cell.h"

namespace isoatlas {

inline constexpr int kCellCases = 656;

/// The loops of one case: loop i is edge[begin[i] .. begin[i + 1]).
struct CellLoops {
    std::uint8_t count;  ///< 0..4
    std::array<std::uint8_t, 5> begin;
    std::array<std::uint8_t, 12> edge;
    [[nodiscard]] int size(int loop) const { return begin[loop + 1] - begin[loop]; }
};

struct CellCaseTables {
    std::array<std::uint8_t, 256> split_faces;          ///< bit f: face f is split by the pattern
    std::array<std::uint16_t, 256> hit_edges;           ///< bit e: edge e is hit
    std::array<std::uint16_t, 256> first_case;          ///< the case with no face joined
    std::array<std::uint16_t, 256 * 64> numbered_case;  ///< [pattern * 64 + joined]; joined bits of faces that are not split are ignored
    std::array<CellLoops, kCellCases> loops;
    /// One pattern and joined mask of each case.
    std::array<std::uint8_t, kCellCases> pattern_of, joined_of;

    [[nodiscard]] int case_of(int pattern, int joined) const {
        return joined == 0 ? first_case[pattern] : numbered_case[pattern * 64 + joined];
    }
};

/// Made once, from the links of the faces.
const CellCaseTables& cell_cases();

/// The loops of (pattern, joined).
inline const CellLoops& cell_loops(int pattern, int joined) { return cell_cases().loops[cell_cases().case_of(pattern, joined)]; }

/// Links of one face as directed pairs of edges (from, to), Highs to the right seen from outside. 0, 1 or 2 pairs; edge numbers of the
/// cell.
struct FaceLinks {
    int count = 0;
    std::array<std::array<int, 2>, 2> link{};
};
FaceLinks face_links(int pattern, int joined, int face);

}  // namespace isoatlas
