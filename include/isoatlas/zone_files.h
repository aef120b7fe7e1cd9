// Zone files: the dissertation's own storage. Active cells, and the surface, of an isovalue from a file that the criticality tree leads
// into; the volume is not needed.
//
// The file has the criticality tree, which an open file keeps in memory, and lists of cells with their samples, in blocks. Two layouts:
//   by_zone  as in the dissertation: a list for each component of a zone. The points of a zone are its voxels, and those around its object
//            that wait to be flooded when the zone ends; cells with such a point at a corner are in its file, those that share points in
//            one component. A cell lies in the files of all zones between its highest and its lowest sample: O(cells * depth) entries.
//   by_path  a list for each heavy path of the tree (an event continues the path of its child with most events above it). A cell is in
//            the list of a path once, with the isovalues (low, high] at which the surface of an object of the path crosses it: at most
//            4 * (1 + log2(events)) entries a cell, since a cell has at most 4 samples above their neighbours in it, and whoever goes down
//            from one of these to the root changes the path at most log2(events) times.
// A list that fits into a block is sorted by the highest sample, as in the dissertation; such lists lie one after another in blocks, none
// in two. A longer one is an I/O-optimal interval tree (isoatlas/disk_search.h). A cell whose samples are equal is never active, and left
// out.
//
// In the literature: the dissertation, sections 10.1 and 11.2, chapter 13. docs/methods.md.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/cell_search.h"
#include "isoatlas/search_table.h"
#include "isoatlas/surface.h"

namespace isoatlas {

enum class ZoneLayout : std::uint8_t { by_zone, by_path };

struct ZoneFileOptions {
    std::int64_t block_bytes = 4096;  ///< 512 to 65536, a power of two
    ZoneLayout layout = ZoneLayout::by_path;
    std::int64_t max_entries = std::int64_t{1} << 28;  ///< more are refused, by zone before any is made
};

/// Writes the lists of all cells. analysis: of the volume, with zones. Throws Error: usage (block size; no zones; another volume), resource
/// (2^32 cells or more, more entries than allowed, the disk), cancelled. Cost: a sort of the entries, for each interval tree those of
/// write_interval_tree(); 24 to 96 bytes an entry and three copies of the longest list, in the scratch file where the environment has a
/// budget (context.h). The same bytes with any budget and for any threads.
void write_zone_files(const std::string& path, const Volume& volume, const Analysis& analysis, const ZoneFileOptions& options = {},
                      const Context& context = {});

/// Entries of the lists that write_zone_files() would write, cells with equal samples included. Cost: O(cells log events).
[[nodiscard]] std::int64_t count_zone_file_entries(const Volume& volume, const Analysis& analysis, ZoneLayout layout,
                                                   const Context& context = {});

/// What a query has opened.
struct ZoneFileReads {
    std::int64_t zones = 0;         ///< active: of which tau lies in (value of the parent, value]; by_path: paths
    std::int64_t components = 0;    ///< whose list has cells below and above tau, so that it is read
    std::int64_t cells_filed = 0;   ///< in the lists of all active zones, cells with equal samples included
    std::int64_t cells_loaded = 0;  ///< in lists that were read; of interval trees: entries that blocks which were read have room for
    std::int64_t cells_visited = 0;
    std::int64_t entries_active = 0;  ///< at least as many as active cells: a cell may lie in the lists of several objects
};

/// An open file.
class ZoneFileSearch final : public CellSearch {
public:
    /// Throws Error{input}: missing, not such a file, truncated, damaged. Reads the tree.
    explicit ZoneFileSearch(const std::string& path);
    ~ZoneFileSearch() override;

    /// Ascending. nodes: of the tree that were visited, and nodes of interval trees. Throws Error{input}: damaged.
    [[nodiscard]] std::vector<CellId> active(double tau, CellSearchCost& cost) override;
    /// The surface, from the file alone: samples at the corners of active cells are in their entries, and any other sample is on the same
    /// side of tau as its neighbours. The same bytes as extract() of the volume. Throws Error: usage if options ask for normals, which need
    /// samples beyond active cells, for ids, objects or contours, which are named after such samples, or for a closed surface of a volume
    /// without cells; input: damaged. Cost: O(volume) memory and time beside the query.
    [[nodiscard]] Surface extract(double tau, const ExtractOptions& options, CellSearchCost& cost, const Context& context = {});
    /// Of the last query.
    [[nodiscard]] const ZoneFileReads& reads() const;
    void drop_pages() override;

    /// The tree in memory.
    [[nodiscard]] std::int64_t bytes() const override;
    [[nodiscard]] std::int64_t file_bytes() const override;
    [[nodiscard]] std::int64_t block_bytes() const;
    [[nodiscard]] ZoneLayout layout() const;
    [[nodiscard]] std::int64_t events() const;
    [[nodiscard]] std::int64_t zones() const;       ///< by_path: paths
    [[nodiscard]] std::int64_t components() const;  ///< lists
    [[nodiscard]] std::int64_t entries() const;     ///< of all lists

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// An isovalue of table 13.1, counted and read.
struct ZoneFileRow {
    SearchCost counted{};
    CellSearchCost cost;
    ZoneFileReads reads;
    std::int64_t brick_bytes = 0;  ///< that a store reads for the surface; 0: no store

    [[nodiscard]] double load_utility() const;    ///< percent: active / loaded; nothing loaded: 0
    [[nodiscard]] double travel_utility() const;  ///< percent: active / visited
};

/// Queries the isovalues of search_costs(), or `most` of them, evenly chosen. store: an atlas of the volume, opened anew for each; empty:
/// none. by_path: counted.zones_loaded and zones_visited are 0, as the file has no such lists and counting them would take most of the
/// time. What counts and reads have in common is the same: `active`, and, by_zone, reads.cells_filed == counted.zones_loaded. They differ
/// where the table has a file for a zone and the dissertation one for a component: lists without active cells are not loaded, and each
/// list that is loaded may have a last cell below tau that is visited. Of an interval tree, what is loaded are the blocks that are read,
/// and what is visited are a few cells more than the active ones, not all from the highest down.
/// Throws Error: usage (most < 1), as search_costs(), ZoneFileSearch::active(), Atlas.
[[nodiscard]] std::vector<ZoneFileRow> zone_file_table(ZoneFileSearch& file, const Volume& volume, const Analysis& analysis,
                                                       std::int64_t most, const std::string& store = {}, const Context& context = {});

}  // namespace isoatlas
