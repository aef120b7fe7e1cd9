#include "isoatlas/cell_search.h"

#include "field/volume_view.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "methods/search/active_list.h"
#include "methods/search/brute_force.h"
#include "methods/search/chessboard.h"
#include "methods/search/extrema_graph.h"
#include "methods/search/interval_tree.h"
#include "methods/search/octree.h"
#include "methods/search/span_filter.h"
#include "methods/search/span_space_tree.h"
#include "methods/search/sweeping_simplices.h"

namespace isoatlas {
namespace {

constexpr std::array<SearchMethodInfo, 10> kMethods{{
    {SearchMethod::brute_force, "brute-force", "Brute force", "3.2", "Lorensen, Cline, Marching Cubes, 1987", "n"},
    {SearchMethod::octree, "octree", "Octree, even subdivision", "3.7.1", "Meagher, Geometric modeling using octree encoding, 1982",
     "k log(n / k)"},
    {SearchMethod::branch_on_need_octree, "bono", "Branch-on-need octree", "3.7.1",
     "Wilhelms, Van Gelder, Octrees for faster isosurface generation, 1992", "k log(n / k)"},
    {SearchMethod::extrema_graph, "extrema-graph", "Extrema graph", "3.7.2",
     "Itoh, Koyamada, Automatic isosurface propagation using an extrema graph and sorted boundary cell lists, 1995", "n^(2/3) + k"},
    {SearchMethod::span_filter, "span-filter", "Span filter", "3.8.1", "Gallagher, Span filtering, 1991", "n"},
    {SearchMethod::active_list, "active-list", "Active list", "3.8.2", "Giles, Haimes, Advanced interactive visualization for CFD, 1990",
     "n"},
    {SearchMethod::sweeping_simplices, "sweeping-simplices", "Sweeping simplices", "3.8.3", "Shen, Johnson, Sweeping simplices, 1995", "n"},
    {SearchMethod::span_space_tree, "span-space-tree", "Kd-tree of the span space", "3.8.4",
     "Livnat, Shen, Johnson, A near optimal isosurface extraction algorithm using the span space, 1996", "n^(1/2) + k"},
    {SearchMethod::interval_tree, "interval-tree", "Interval tree", "3.8.5",
     "Cignoni, Marino, Montani, Puppo, Scopigno, Speeding up isosurface extraction using interval trees, 1997", "log n + k"},
    {SearchMethod::chessboard_interval_tree, "chessboard", "Interval tree of a chessboard", "3.8.5",
     "Cignoni, Marino, Montani, Puppo, Scopigno, Speeding up isosurface extraction using interval trees, 1997", "log n + k"},
}};

/// Refuses isovalues that are none, for all methods.
class Checked final : public CellSearch {
public:
    explicit Checked(std::unique_ptr<CellSearch> search) : search_(std::move(search)) {}
    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        require_isovalue(tau);
        return search_->active(tau, cost);
    }
    std::int64_t bytes() const override { return search_->bytes(); }

private:
    std::unique_ptr<CellSearch> search_;
};

template <class T>
std::unique_ptr<CellSearch> search_of(SearchMethod method, const CellGrid<T>& grid) {
    switch (method) {
        case SearchMethod::brute_force: return std::make_unique<BruteForce<T>>(grid);
        case SearchMethod::octree: return std::make_unique<Octree<T>>(grid, Subdivision::even);
        case SearchMethod::branch_on_need_octree: return std::make_unique<Octree<T>>(grid, Subdivision::branch_on_need);
        case SearchMethod::extrema_graph: return std::make_unique<ExtremaGraph<T>>(grid);
        case SearchMethod::span_filter: return std::make_unique<SpanFilter<T>>(grid);
        case SearchMethod::active_list: return std::make_unique<ActiveList<T>>(grid);
        case SearchMethod::sweeping_simplices: return std::make_unique<SweepingSimplices<T>>(grid);
        case SearchMethod::span_space_tree: return std::make_unique<SpanSpaceTree<T>>(grid);
        case SearchMethod::interval_tree: return std::make_unique<IntervalTreeSearch<T>>(grid);
        case SearchMethod::chessboard_interval_tree: return std::make_unique<ChessboardIntervalTree<T>>(grid);
    }
    throw Error(ErrorKind::usage, {.what = "no such search method"});
}

}  // namespace

std::span<const SearchMethodInfo> search_methods() { return kMethods; }

const SearchMethodInfo& info_of(SearchMethod method) { return kMethods[static_cast<std::size_t>(method)]; }

std::unique_ptr<CellSearch> make_cell_search(SearchMethod method, const Volume& volume, const Context& context) {
    const EnvironmentScope scope(context);
    return visit_samples(VolumeView(volume), [&]<class T>(std::span<const T> samples) -> std::unique_ptr<CellSearch> {
        const CellGrid<T> grid(volume.info.extent, samples);
        require_countable(grid.count(), volume.info.path);
        return std::make_unique<Checked>(search_of(method, grid));
    });
}

}  // namespace isoatlas
