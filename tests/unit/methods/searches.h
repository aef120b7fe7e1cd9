// Every search of a volume, in memory and in a file.
#pragma once

#include <algorithm>
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

class Searches {
public:
    struct Named {
        std::string name;
        std::unique_ptr<isoatlas::CellSearch> search;
    };

    explicit Searches(const isoatlas::Volume& volume, std::int64_t block_bytes = 4096) {
        for (const isoatlas::SearchMethodInfo& info : isoatlas::search_methods())
            all_.push_back({std::string(info.name), isoatlas::make_cell_search(info.method, volume)});
        const isoatlas::ReplacedFileSystem files(disk_);
        isoatlas::write_interval_tree("tree", volume, {.block_bytes = block_bytes});
        all_.push_back({"interval-tree-file", std::make_unique<isoatlas::IntervalTreeFile>("tree")});
        isoatlas::write_zone_files("zones", volume, isoatlas::analyse(volume), {.block_bytes = block_bytes});
        all_.push_back({"zone-files", std::make_unique<isoatlas::ZoneFileSearch>("zones")});
        isoatlas::build_atlas("atlas", volume);
        all_.push_back({"bricks", std::make_unique<isoatlas::BrickSearch>("atlas")});
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
