#include "oracle/homology.h"

#include <algorithm>
#include <map>
#include <set>

namespace oracle {
namespace {

using Chain = std::set<Index>;  // numbers of edges, mod 2

void add(Chain& chain, Index edge) {
    if (!chain.insert(edge).second) chain.erase(edge);
}

struct Edge {
    Index from, to, rank;  ///< rank: of the lower end
};
struct Disk {
    Chain rim;
    Index rank;
};

class Complex {
public:
    explicit Complex(const Elements& elements) : elements_(elements), grid_(elements.grid) {
        for (Index v = 0; v < grid_.voxels(); ++v) {
            for (int d = 1; d < grid_.directions(); d += 2) {
                if (grid_.neighbour(v, d) >= 0) add_edge(v, grid_.neighbour(v, d));
            }
        }
        for (Index v = 0; v < grid_.voxels(); ++v) {
            for (int o = 0; o < (grid_.rank == 2 ? 1 : 3); ++o) add_face(v, o);
        }
        for (Index v = 0; v < grid_.voxels(); ++v) add_cell(v);
    }

    std::vector<HolePair> pairs() {
        // Rows: edges by descending rank. Columns: disks by descending rank.
        std::vector<Index> order(edges_.size()), row(edges_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
        std::stable_sort(order.begin(), order.end(), [this](Index p, Index q) { return edges_[p].rank > edges_[q].rank; });
        for (std::size_t i = 0; i < order.size(); ++i) row[order[i]] = static_cast<Index>(i);
        std::stable_sort(disks_.begin(), disks_.end(), [](const Disk& p, const Disk& q) { return p.rank > q.rank; });
        std::map<Index, Chain> reduced;  // by lowest row
        std::vector<HolePair> pairs;
        for (const Disk& disk : disks_) {
            Chain column;
            for (const Index edge : disk.rim) column.insert(row[edge]);
            while (!column.empty() && reduced.count(*column.rbegin()) != 0) {
                for (const Index r : Chain(reduced[*column.rbegin()])) add(column, r);
            }
            if (column.empty()) continue;
            const double opens = value_at(edges_[order[*column.rbegin()]].rank), closes = value_at(disk.rank);
            if (opens > closes) pairs.push_back({opens, closes});
            reduced[*column.rbegin()] = column;
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

private:
    double value_at(Index rank) const { return elements_.all[elements_.by_rank[rank]].value; }
    Index lower_rank(Index p, Index q) const { return std::min(elements_.rank_of[p], elements_.rank_of[q]); }

    void add_edge(Index p, Index q) {
        number_[{std::min(p, q), std::max(p, q)}] = static_cast<Index>(edges_.size());
        edges_.push_back({p, q, lower_rank(p, q)});
    }
    Index edge(Index p, Index q) const { return number_.at({std::min(p, q), std::max(p, q)}); }

    void add_disk(const Chain& rim) {
        Index rank = elements_.count();
        for (const Index e : rim) rank = std::min(rank, edges_[e].rank);
        disks_.push_back({rim, rank});
    }

    /// Corner x + 2y + 4z of the cell of voxel v, or -1.
    Index corner(Index v, int k) const {
        const auto p = grid_.voxel(v);
        const std::array<Index, 3> q{p[0] + (k & 1), p[1] + (k >> 1 & 1), p[2] + (k >> 2)};
        return grid_.contains(q) ? grid_.index(q[0], q[1], q[2]) : -1;
    }

    void add_face(Index v, int o) {
        const int first = o == 2 ? 2 : 1, second = o == 0 ? 2 : 4;
        const std::array<Index, 4> c{v, corner(v, first), corner(v, first | second), corner(v, second)};
        if (c[1] < 0 || c[3] < 0) return;
        const Index point = elements_.face_at[3 * v + o];
        Chain square;
        for (int i = 0; i < 4; ++i) {
            square.insert(edge(c[i], c[(i + 1) % 4]));
            if (point >= 0) add_edge(point, c[i]);
        }
        if (point < 0) return add_disk(square);
        for (int i = 0; i < 4; ++i) add_disk({edge(c[i], c[(i + 1) % 4]), edge(point, c[i]), edge(point, c[(i + 1) % 4])});
    }

    /// A disk for every edge on the border of the cell that closes a loop, when edges come in descending order.
    void add_cell(Index v) {
        if (grid_.rank == 2 || corner(v, 7) < 0) return;
        std::set<Index> corners, elements;
        for (int k = 0; k < 8; ++k) corners.insert(corner(v, k));
        elements = corners;
        for (Index e = grid_.voxels(); e < elements_.count(); ++e) {
            const auto& around = elements_.all[e].corner;
            if (std::all_of(around.begin(), around.end(), [&](Index c) { return corners.count(c) != 0; })) elements.insert(e);
        }
        std::vector<Index> border;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (elements.count(edges_[e].from) != 0 && elements.count(edges_[e].to) != 0) border.push_back(static_cast<Index>(e));
        }
        std::stable_sort(border.begin(), border.end(), [this](Index p, Index q) { return edges_[p].rank > edges_[q].rank; });
        std::map<Index, Chain> way;  // from the first element of its tree to every element
        std::map<Index, Index> tree;
        for (const Index e : elements) tree[e] = e;
        for (const Index b : border) {
            const auto [from, to, rank] = edges_[b];
            Chain loop = way[from];
            for (const Index e : way[to]) add(loop, e);
            add(loop, b);
            if (tree[from] == tree[to]) {
                disks_.push_back({loop, rank});
                continue;
            }
            const Index old = tree[to];  // its ways begin where those of `from` do now
            for (auto& [e, t] : tree) {
                if (t != old) continue;
                t = tree[from];
                for (const Index step : loop) add(way[e], step);
            }
        }
    }

    const Elements& elements_;
    const Grid& grid_;
    std::vector<Edge> edges_;
    std::map<std::pair<Index, Index>, Index> number_;
    std::vector<Disk> disks_;
};

}  // namespace

std::vector<HolePair> hole_pairs(const Elements& elements) { return Complex(elements).pairs(); }

}  // namespace oracle
