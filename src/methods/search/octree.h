// Octree over the cells (section 3.7.1): every node knows the lowest and the highest sample of its box; boxes that tau does not divide are
// not entered. Leaves are boxes of at most 2 cells along each axis.
//
// Even subdivision cuts a box in the middle; branch-on-need (Wilhelms, Van Gelder, Octrees for faster isosurface generation, 1992) gives
// the lower part the largest power of two that is smaller than the box, so that nearly all nodes have eight children whatever the size.
#pragma once

#include <bit>

#include "methods/search/cell_grid.h"

namespace isoatlas {

enum class Subdivision : std::uint8_t { even, branch_on_need };

template <class T>
class Octree final : public CellSearch {
public:
    Octree(const CellGrid<T>& grid, Subdivision subdivision) : grid_(grid) {
        if (grid.count() == 0) return;
        nodes_.push_back({{0, 0, 0}, grid.size, {}, {}, 0, 0});
        for (std::size_t i = 0; i < nodes_.size(); ++i) divide(i, subdivision);
        for (std::size_t i = nodes_.size(); i-- > 0;) measure(nodes_[i]);  // children come behind their parents
    }

    std::vector<CellId> active(double tau, CellSearchCost& cost) override {
        std::vector<CellId> found;
        cost = {};
        std::vector<std::uint32_t> open;
        if (!nodes_.empty()) open.push_back(0);
        while (!open.empty()) {
            const Node& node = nodes_[open.back()];
            open.pop_back();
            ++cost.nodes;
            if (!(static_cast<double>(node.low) < tau && tau <= static_cast<double>(node.high))) continue;
            for (std::uint32_t child = node.first; child < node.first + node.children; ++child) open.push_back(child);
            if (node.children == 0) look_into(node, tau, found, cost);
        }
        cost.active = std::ssize(found);
        return found;
    }
    std::int64_t bytes() const override { return bytes_of(nodes_); }

private:
    /// A box of cells [begin, end).
    struct Node {
        Index3 begin, end;
        T low, high;
        std::uint32_t first, children;
    };

    static std::int64_t middle(std::int64_t begin, std::int64_t end, Subdivision subdivision) {
        const auto size = static_cast<std::uint64_t>(end - begin);
        const std::uint64_t lower = subdivision == Subdivision::even ? (size + 1) / 2 : std::bit_floor(size - 1);
        return begin + static_cast<std::int64_t>(lower);
    }

    void divide(std::size_t number, Subdivision subdivision) {
        const Node node = nodes_[number];
        std::array<std::vector<std::int64_t>, 3> cuts;
        bool is_leaf = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t size = node.end[axis] - node.begin[axis];
            cuts[axis] = {node.begin[axis]};
            if (size > 2) cuts[axis].push_back(middle(node.begin[axis], node.end[axis], subdivision)), is_leaf = false;
            cuts[axis].push_back(node.end[axis]);
        }
        if (is_leaf) return;
        nodes_[number].first = static_cast<std::uint32_t>(nodes_.size());
        for (std::size_t z = 0; z + 1 < cuts[2].size(); ++z) {
            for (std::size_t y = 0; y + 1 < cuts[1].size(); ++y) {
                for (std::size_t x = 0; x + 1 < cuts[0].size(); ++x) {
                    nodes_.push_back(
                        {{cuts[0][x], cuts[1][y], cuts[2][z]}, {cuts[0][x + 1], cuts[1][y + 1], cuts[2][z + 1]}, {}, {}, 0, 0});
                }
            }
        }
        nodes_[number].children = static_cast<std::uint32_t>(nodes_.size()) - nodes_[number].first;
    }

    template <class Visit>
    static void for_cells(const Node& node, const Visit& visit) {
        for (std::int64_t z = node.begin[2]; z < node.end[2]; ++z) {
            for (std::int64_t y = node.begin[1]; y < node.end[1]; ++y) {
                for (std::int64_t x = node.begin[0]; x < node.end[0]; ++x) visit(Index3{x, y, z});
            }
        }
    }

    void measure(Node& node) const {
        bool is_first = true;
        const auto add = [&](T low, T high) {
            node.low = is_first ? low : std::min(node.low, low);
            node.high = is_first ? high : std::max(node.high, high);
            is_first = false;
        };
        for (std::uint32_t child = node.first; child < node.first + node.children; ++child) add(nodes_[child].low, nodes_[child].high);
        if (node.children > 0) return;
        for_cells(node, [&](const Index3& place) {
            const std::array<T, 2> ends = grid_.interval(place);
            add(ends[0], ends[1]);
        });
    }

    void look_into(const Node& leaf, double tau, std::vector<CellId>& found, CellSearchCost& cost) const {
        for_cells(leaf, [&](const Index3& place) {
            ++cost.cells;
            const std::array<T, 2> ends = grid_.interval(place);
            const CellInterval<T> cell{ends[0], ends[1], grid_.cell(place)};
            if (cell.is_active(tau)) found.push_back(cell.cell);
        });
    }

    CellGrid<T> grid_;
    std::vector<Node> nodes_;
};

}  // namespace isoatlas
