// Methods that find the active cells of an isovalue, each as its paper describes it: comparators, and a place to learn from.
//
// Cells: boxes between 8 neighbouring samples (4 in 2D), (nx-1)(ny-1)(nz-1) of them, numbered with x fastest; a volume with one sample
// along an axis of its rank has none. A cell is *active* at tau when its lowest sample < tau <= its highest. In the literature: chapter 3
// of the dissertation, sections 3.7 and 3.8, a survey of all of these; docs/methods.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/id.h"
#include "isoatlas/method_info.h"
#include "isoatlas/volume.h"

namespace isoatlas {

using CellId = StrongId<struct CellTag, std::uint32_t>;  ///< x + cells_x * (y + cells_y * z)

enum class SearchMethod : std::uint8_t {
    brute_force,
    octree,
    branch_on_need_octree,
    extrema_graph,
    span_filter,
    active_list,
    sweeping_simplices,
    span_space_tree,
    interval_tree,
    chessboard_interval_tree,
};

using SearchMethodInfo = MethodInfo<SearchMethod>;
/// All of them, brute force first.
[[nodiscard]] std::span<const SearchMethodInfo> search_methods();
[[nodiscard]] const SearchMethodInfo& info_of(SearchMethod method);

/// What a query has looked at.
struct CellSearchCost {
    std::int64_t active = 0;
    std::int64_t cells = 0;  ///< looked at: reported, or compared with the isovalue and left out
    std::int64_t nodes = 0;  ///< of the search structure, without cells
    // Of a structure in a file, else 0:
    std::int64_t blocks = 0;      ///< read, each as often as it was
    std::int64_t bytes_read = 0;  ///< of the file
};

/// A search structure over the cells of one volume, in memory or in a file.
class CellSearch {
public:
    CellSearch() = default;
    CellSearch(const CellSearch&) = delete;
    CellSearch& operator=(const CellSearch&) = delete;
    virtual ~CellSearch() = default;

    /// Every active cell once, in any order. tau: a stored value; not a finite number: Error{usage}. Some methods begin with the cells of
    /// the query before; so one query at a time.
    [[nodiscard]] virtual std::vector<CellId> active(double tau, CellSearchCost& cost) = 0;
    /// Of the structure, beside the samples and what a query needs while it runs.
    [[nodiscard]] virtual std::int64_t bytes() const = 0;
    /// Of the file; 0: in memory.
    [[nodiscard]] virtual std::int64_t file_bytes() const { return 0; }
    /// Asks the system to forget its pages of the file, so that the next query reads the disk ("cold"). It may refuse silently. In memory:
    /// nothing.
    virtual void drop_pages() {}
};

/// The samples are borrowed: the volume must live as long as the result. Throws Error: resource (2^32 cells or more), cancelled. Cost: that
/// of a sort of the cells; octrees and brute force a pass over them.
[[nodiscard]] std::unique_ptr<CellSearch> make_cell_search(SearchMethod method, const Volume& volume, const Context& context = {});

}  // namespace isoatlas
