// The components of a zone file: cells that share points of the zone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/big_vector.h"
#include "methods/disk/entry_stream.h"
#include "methods/search/cell_grid.h"
#include "methods/zones/filing_runs.h"

namespace isoatlas {

/// The cells before a cell that touch it, and at which of its corners: those of a slice, a row and a cell more before it.
class EarlierNeighbours {
public:
    struct Neighbour {
        Index3 offset;
        std::uint8_t corners;  ///< that are shared, a bit each
    };
    EarlierNeighbours() {
        for (int i = 0; i < 13; ++i) {
            const Index3 offset{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            unsigned corners = 0;
            for (int k = 0; k < 8; ++k) {
                const std::array<std::int64_t, 3> at{(k & 1) - offset[0], (k >> 1 & 1) - offset[1], (k >> 2) - offset[2]};
                if (std::ranges::all_of(at, [](std::int64_t a) { return a == 0 || a == 1; })) corners |= 1U << k;
            }
            all_[static_cast<std::size_t>(i)] = {offset, static_cast<std::uint8_t>(corners)};
        }
    }
    [[nodiscard]] auto begin() const { return all_.begin(); }
    [[nodiscard]] auto end() const { return all_.end(); }

private:
    std::array<Neighbour, 13> all_{};
};

/// Finds the components of one list after another.
template <class T>
class ComponentsOfList {
public:
    explicit ComponentsOfList(const CellGrid<T>& grid)
        : grid_(grid), seen_(static_cast<std::size_t>(std::min(grid.count(), grid.size[0] * (grid.size[1] + 1) + 2))) {}

    /// Calls visit(cells) for the components of a list, in the order of their first cells. cells: of one node, in order. In the literature:
    /// union-find (Tarjan, 1975). Cost: O(cells) time, two more copies of them, in the scratch file where memory is limited.
    template <class Visit>
    void visit(std::span<Filing<T>> cells, const Visit& visit) {
        join(cells);
        Array<Member> members(cells.size());
        PartWriters<Member> writer({members.data(), members.size()}, kFromTheFirst);
        std::uint32_t i = 0;
        bool is_one = true;
        for_each_entry<Filing<T>>(cells, [&](const Filing<T>& filing) {
            const std::uint32_t component = root(i++);
            is_one = is_one && component == 0;
            writer.put(0, {component, filing});
        });
        writer.finish();
        if (is_one) return visit(std::span<const Filing<T>>(cells));
        std::vector<std::size_t> ends;
        std::uint32_t current = 0;
        put_in_order<InOrder>(std::span(members), [&](std::size_t first, std::span<const Member> some) {
            write_fields<Filing<T>>(cells.subspan(first, some.size()), some, [](const Member& m) { return m.filing; });
            for (std::size_t k = 0; k < some.size(); ++k) {
                if (std::exchange(current, some[k].component) != some[k].component) ends.push_back(first + k);
            }
        });
        ends.push_back(cells.size());
        std::size_t begin = 0;
        for (const std::size_t end : ends) visit(std::span<const Filing<T>>(cells.subspan(begin, end - begin))), begin = end;
    }

private:
    struct Member {
        std::uint32_t component;  ///< its first cell
        Filing<T> filing;
    };
    struct InOrder {
        static double key(const Member& member) { return member.component; }
        bool operator()(const Member& p, const Member& q) const {
            return p.component != q.component ? p.component < q.component : p.filing.cell.cell < q.filing.cell.cell;
        }
    };
    /// The last cell of this place, modulo their number, that was in a list.
    struct Seen {
        ZoneNodeId node = ZoneNodeId::none();
        CellId cell{};
        std::uint32_t index = 0;  ///< in the list
    };

    static constexpr std::array<std::size_t, 1> kFromTheFirst{0};  ///< one part

    void join(std::span<const Filing<T>> cells) {
        parent_.resize(cells.size());
        std::uint32_t i = 0;
        for_each_entry<Filing<T>>(cells, [&](const Filing<T>& filing) {
            parent_[i] = i;
            const Index3 place = grid_.place(filing.cell.cell);
            for (const EarlierNeighbours::Neighbour& neighbour : neighbours_) {
                const Index3 other = {place[0] + neighbour.offset[0], place[1] + neighbour.offset[1], place[2] + neighbour.offset[2]};
                if ((filing.points & neighbour.corners) == 0 || !grid_.has(other)) continue;
                const Seen& seen = seen_[grid_.cell(other).index() % seen_.size()];
                if (seen.node != filing.node || seen.cell != grid_.cell(other)) continue;
                const std::uint32_t p = root(i), q = root(seen.index);
                parent_[std::max(p, q)] = std::min(p, q);
            }
            seen_[filing.cell.cell.index() % seen_.size()] = {filing.node, filing.cell.cell, i};
            ++i;
        });
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    const CellGrid<T>& grid_;
    EarlierNeighbours neighbours_;
    std::vector<Seen> seen_;
    Array<std::uint32_t> parent_;
};

}  // namespace isoatlas
