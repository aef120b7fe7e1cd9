// The I/O-optimal interval tree: active cells of an isovalue from a file, in blocks.
//
// In the literature: section 3.8.6 of the dissertation; Chiang, Silva, I/O optimal isosurface extraction, 1997; Arge, Vitter, Optimal
// dynamic interval management in external memory, 1996. docs/methods.md.
#pragma once

#include <memory>
#include <string>

#include "isoatlas/cell_search.h"

namespace isoatlas {

struct IntervalTreeFileOptions {
    std::int64_t block_bytes = 4096;  ///< 512 to 65536, a power of two
};

/// Writes the tree of all cells of a volume. Throws Error: usage (block size), resource (2^32 cells or more, the disk), cancelled. Cost:
/// two sorts of the cells and two passes over them for each level; memory: two copies of them, in the scratch file where the environment
/// has a budget (context.h). The same bytes with any budget.
void write_interval_tree(const std::string& path, const Volume& volume, const IntervalTreeFileOptions& options = {},
                         const Context& context = {});
/// The same of a volume that is read slab by slab, with a policy for missing samples as load_volume() has: within the budget of the
/// environment, samples included. Throws as load_volume(), too.
void write_interval_tree(const std::string& path, VolumeReader& reader, const MissingPolicy& missing = {},
                         const IntervalTreeFileOptions& options = {}, const Context& context = {});

/// An open tree. Blocks are read when a query needs them, two at a time in memory, and verified by their checksums. A node is a block.
/// A query reads at most 5 k / B + 8 l + 2 blocks: k cells are active, a block has B, the path has l <= levels() nodes.
class IntervalTreeFile final : public CellSearch {
public:
    /// Throws Error{input}: missing, not such a file, truncated, damaged.
    explicit IntervalTreeFile(const std::string& path);
    ~IntervalTreeFile() override;

    /// Throws Error{input}: damaged.
    [[nodiscard]] std::vector<CellId> active(double tau, CellSearchCost& cost) override;
    [[nodiscard]] std::int64_t bytes() const override;
    [[nodiscard]] std::int64_t file_bytes() const override;
    void drop_pages() override;
    [[nodiscard]] std::int64_t block_bytes() const;
    [[nodiscard]] std::int64_t cells() const;  ///< that are active at some isovalue
    [[nodiscard]] int slabs() const;           ///< children of a node, at most
    /// Of nodes: at most log(cells / B) to the base of slabs(), rounded up.
    [[nodiscard]] int levels() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
