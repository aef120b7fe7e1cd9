// Every search of a volume, in memory and in a file.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "faults/memory_files.h"
#include "isoatlas/analysis.h"
#include "isoatlas/brick_search.h"
#include "isoatlas/build.h"
#include "isoatlas/disk_search.h"
#include "isoatlas/zone_files.h"

namespace oracle {

/// Builds one search.
struct SearchMaker {
    std::string name;
    std::function<std::unique_ptr<isoatlas::CellSearch>()> make;
};

/// Of the volume, which is borrowed; those in files: in names that begin with `prefix`.
inline std::vector<SearchMaker> search_makers(const isoatlas::Volume& volume, const std::string& prefix, std::int64_t block_bytes = 4096) {
    std::vector<SearchMaker> makers;
    for (const isoatlas::SearchMethodInfo& info : isoatlas::search_methods())
        makers.push_back({std::string(info.name), [&volume, method = info.method] { return isoatlas::make_cell_search(method, volume); }});
    makers.push_back({"interval-tree-file", [&volume, path = prefix + "tree", block_bytes] {
                          isoatlas::write_interval_tree(path, volume, {.block_bytes = block_bytes});
                          return std::make_unique<isoatlas::IntervalTreeFile>(path);
                      }});
    makers.push_back({"zone-files", [&volume, path = prefix + "zones", block_bytes] {
                          isoatlas::write_zone_files(path, volume, isoatlas::analyse(volume), {.block_bytes = block_bytes});
                          return std::make_unique<isoatlas::ZoneFileSearch>(path);
                      }});
    makers.push_back({"bricks", [&volume, path = prefix + "atlas"] {
                          isoatlas::build_atlas(path, volume);
                          return std::make_unique<isoatlas::BrickSearch>(path);
                      }});
    return makers;
}

/// All of them at once, their files in memory.
class Searches {
public:
    struct Named {
        std::string name;
        std::unique_ptr<isoatlas::CellSearch> search;
    };

    explicit Searches(const isoatlas::Volume& volume, std::int64_t block_bytes = 4096) {
        const isoatlas::ReplacedFileSystem files(disk_);
        for (const SearchMaker& maker : search_makers(volume, "", block_bytes)) all_.push_back({maker.name, maker.make()});
    }
    [[nodiscard]] std::vector<Named>& all() { return all_; }

private:
    isoatlas::test::MemoryFiles disk_;
    std::vector<Named> all_;
};

/// Ascending.
inline std::vector<isoatlas::CellId> found(isoatlas::CellSearch& search, double tau, isoatlas::CellSearchCost& cost) {
    std::vector<isoatlas::CellId> cells = search.active(tau, cost);
    std::sort(cells.begin(), cells.end());
    return cells;
}

}  // namespace oracle
