// The active cells of an isovalue from the bricks of a store: how the product finds them, beside the methods of the literature.
//
// A store knows the lowest and the highest sample of every brick of 16 x 8 x 8 samples. Bricks that the isovalue divides are read, and
// those around them that a surface with normals needs; a cell is active when its samples are not of one class. docs/decisions/0009,
// docs/methods.md.
#pragma once

#include <memory>
#include <string>

#include "isoatlas/cell_search.h"

namespace isoatlas {

/// An open store (isoatlas/atlas.h); of one polarity as it is, of both that of high values. Nothing stays between queries, so all of them
/// read as a first one. Counters: nodes are bricks whose lowest and highest sample are looked at, blocks are bricks read, cells are those
/// whose first corner lies in such a brick.
class BrickSearch final : public CellSearch {
public:
    /// Throws Error: input (missing, not a store, damaged), resource (2^32 cells or more).
    explicit BrickSearch(const std::string& path);
    ~BrickSearch() override;

    /// The cells in the order of their numbers. Throws Error: usage (tau is not a finite number), input (damaged).
    [[nodiscard]] std::vector<CellId> active(double tau, CellSearchCost& cost) override;
    /// Lowest and highest sample of every brick.
    [[nodiscard]] std::int64_t bytes() const override;
    [[nodiscard]] std::int64_t file_bytes() const override;
    void drop_pages() override;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
