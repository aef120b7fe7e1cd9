// Exact persistence pairs of tunnels: reduction of a boundary matrix mod 2 (Edelsbrunner, Letscher, Zomorodian 2002).
//
// Rows are the elements that open a tunnel, columns those that close one. Elements that merge objects or part low components are paired by
// the trees: a merge is never the lowest of a reduced column, so its row is left out; a parting element has the column 0.
//
// A disk is followed upwards to the first element that opened what no earlier column is paired with; most tunnels close where they opened,
// so that is near (Bauer, Ripser: efficient computation of Vietoris-Rips persistence barcodes, 2021: emergent pairs). What lies above it is
// kept as edges that have not been replaced yet, and followed only where the column is added to another one. docs/decisions/0047.
#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/big_vector.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/phase.h"
#include "field/volume_view.h"
#include "isoatlas/environment.h"
#include "persistence/descending_disk.h"
#include "persistence/handle_pairs.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBatch = 256;  // columns

/// Events of the object of an event, all when it is none.
template <class Id>
std::vector<bool> events_inside(const AnalysisArrays<Id>& arrays, EventId event) {
    std::vector<bool> inside(arrays.tree.size(), !event.exists());
    if (!event.exists()) return inside;
    inside[event.index()] = true;
    for (std::size_t e = event.index(); e-- > 0;) inside[e] = inside[arrays.tree.parent[EventId(e)].index()];
    return inside;
}

/// Elements that open and that close tunnels, descending.
struct TunnelElements {
    std::vector<ElementId> opening, closing;
};

template <class Id>
TunnelElements tunnel_elements(const AnalysisArrays<Id>& arrays, EventId event) {
    const std::vector<bool> inside = events_inside(arrays, event);
    TunnelElements elements;
    for (const auto x : arrays.code.ids()) {
        const ElementCode code{arrays.code[x]};
        const bool in_one_contour = arrays.contours.above(x) == 1 && arrays.contours.below(x) == 1;
        if (!in_one_contour || !inside[arrays.tree.event_of_element[x].index()]) continue;
        if (code.h0() == 2) elements.opening.emplace_back(x);
        if (code.l0() == 2) elements.closing.emplace_back(x);
    }
    return elements;
}

template <class T, class Id>
class Reduction {
public:
    Reduction(const GridView<T>& grid, double tunnel_height, const AnalysisArrays<Id>& arrays, EventId event, const Context& context)
        : arrays_(arrays), event_(event), context_(context), disks_(grid, tunnel_height), elements_(tunnel_elements(arrays, event)) {
        for (std::size_t row = 0; row < elements_.opening.size(); ++row)
            row_of_[place_of(ElementCode{arrays.code[elements_.opening[row]]})] = static_cast<std::int64_t>(row);
    }

    [[nodiscard]] std::int64_t tunnels() const { return static_cast<std::int64_t>(elements_.opening.size()); }

    [[nodiscard]] std::vector<HandlePair> pairs() {
        const auto closing = static_cast<std::int64_t>(elements_.closing.size());
        std::vector<Column> columns(static_cast<std::size_t>(kBatch));
        for (std::int64_t first = 0; first < closing; first += kBatch) {
            stop_if_cancelled(context_);
            report(context_, only_phase("tunnels"), static_cast<double>(first) / static_cast<double>(closing));
            const std::int64_t count = std::min(kBatch, closing - first);
            for_each_block(context_.threads, count, [&](std::int64_t i) { columns[i] = column(single(elements_.closing[first + i])); });
            for (std::int64_t i = 0; i < count; ++i) pair(std::move(columns[i]), elements_.closing[first + i]);
        }
        add_open();
        return std::move(pairs_);
    }

private:
    using Chain = typename DescendingDisks<T>::Chain;
    using Edge = typename DescendingDisks<T>::Edge;

    /// A sum of columns mod 2, followed up to its lowest row.
    struct Sum {
        Chain chain;  ///< above that row
        std::optional<std::int64_t> row;
    };

    /// A sum that is not added to, by its edges that are there an odd number of times, ascending.
    struct Column {
        std::vector<Edge> edges;
        std::optional<std::int64_t> row;
    };

    [[nodiscard]] std::optional<std::int64_t> next_row(Chain& chain) const {
        while (const std::optional<ElementPlace> place = disks_.next(chain)) {
            const auto row = row_of_.find(*place);
            if (row != row_of_.end()) return row->second;
        }
        return std::nullopt;
    }

    [[nodiscard]] Sum single(ElementId element) const {
        Sum one;
        disks_.add(ElementCode{arrays_.code[element]}, one.chain);
        one.row = next_row(one.chain);
        return one;
    }

    /// Adds paired columns until the lowest row is of none.
    [[nodiscard]] Sum reduced(Sum one) const {
        while (one.row) {
            const auto other = paired_.find(*one.row);
            if (other == paired_.end()) break;
            for (const Edge& edge : other->second) one.chain.push(edge);  // both end in that row
            one.row = next_row(one.chain);
        }
        return one;
    }

    /// The edges that are there an odd number of times, ascending.
    [[nodiscard]] static std::vector<Edge> edges_of(Chain& chain) {
        std::vector<Edge> edges;
        while (!chain.empty()) {
            if (!edges.empty() && edges.back() == chain.top())
                edges.pop_back();
            else
                edges.push_back(chain.top());
            chain.pop();
        }
        edges.shrink_to_fit();
        return edges;
    }

    [[nodiscard]] Column column(Sum one) const {
        one = reduced(std::move(one));
        return {edges_of(one.chain), one.row};
    }

    void pair(Column one, ElementId element) {
        if (one.row && paired_.contains(*one.row))
            one = column({Chain(std::greater<>{}, std::move(one.edges)), one.row});  // one of this batch
        ISOATLAS_CHECK(one.row.has_value());                                         // it closes a tunnel
        pairs_.push_back({elements_.opening[*one.row], element});
        paired_.emplace(*one.row, std::move(one.edges));
    }

    /// Tunnels that are still open when the object merges.
    void add_open() {
        const bool is_root = !event_.exists() || arrays_.tree.is_root(event_);
        ISOATLAS_CHECK(!is_root || pairs_.size() == elements_.opening.size());
        if (is_root) return;
        const ElementId merge(arrays_.tree.top[arrays_.tree.parent[event_]]);
        for (std::size_t row = 0; row < elements_.opening.size(); ++row) {
            if (!paired_.contains(static_cast<std::int64_t>(row))) pairs_.push_back({elements_.opening[row], merge, true});
        }
    }

    const AnalysisArrays<Id>& arrays_;
    EventId event_;
    const Context& context_;
    DescendingDisks<T> disks_;
    TunnelElements elements_;
    std::unordered_map<ElementPlace, std::int64_t> row_of_;
    std::unordered_map<std::int64_t, std::vector<Edge>> paired_;  // by lowest row: the reduced column above it
    std::vector<HandlePair> pairs_;
};

void check(const Volume& volume, const Analysis& analysis, const ExactHandles& options) {
    if (volume.info.extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
    if (options.event >= EventId(analysis.event_count()))
        throw Error(ErrorKind::usage, {.what = "there is no event " + std::to_string(options.event.number())});
}

void check_size(std::int64_t tunnels, std::int64_t max) {
    if (tunnels <= max) return;
    throw Error(ErrorKind::usage, {.what = std::to_string(tunnels) + " tunnels are too many to pair exactly",
                                   .expected = "at most " + std::to_string(max),
                                   .next = "take one object, filter the volume first, or take the approximate pairs"});
}

}  // namespace

std::vector<Handle> pair_handles_exactly(const Volume& volume, const Analysis& analysis, const ExactHandles& options,
                                         const Context& context) {
    const EnvironmentScope scope(context);
    check(volume, analysis, options);
    if (analysis.extent().rank == 2) return {};
    const double tunnel_height = tunnel_height_of(analysis.interpolant(), analysis.tunnel_height());
    return analysis.data().visit([&](const auto& held) {
        return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
            const GridView<T> grid{samples.data(), volume.info.extent};
            Reduction reduction(grid, tunnel_height, held.arrays, options.event, context);
            check_size(reduction.tunnels(), options.max);
            return handles_of(held.arrays, analysis.extent(), reduction.pairs(), options.min_persistence);
        });
    });
}

EventId event_of_highest(const Analysis& analysis, VoxelId voxel) {
    return analysis.data().visit([&](const auto& held) -> EventId {
        const auto& arrays = held.arrays;
        const auto is_it = [&](std::uint64_t bits) {
            const ElementCode code{bits};
            return code.kind() == CodeKind::vertex && code.h0() == 0 && code.index() == voxel.number();
        };
        const BigVector<std::uint64_t>& code = arrays.code.items();
        const auto found = std::ranges::find_if(code, is_it);
        if (found == code.end()) return EventId::none();
        std::vector<std::size_t> highest(arrays.tree.size());
        for (const auto e : arrays.tree.parent.ids()) highest[e.index()] = e.index();
        for (const auto e : arrays.tree.parent.ids()) {
            std::size_t& below = highest[arrays.tree.parent[e].index()];
            below = std::min(below, highest[e.index()]);
        }
        const ElementId element(found - code.begin());
        auto event = arrays.tree.event_of_element[element];
        const std::size_t top = event.index();
        if (arrays.tree.top[event].index() != element.index()) return EventId::none();
        while (!arrays.tree.is_root(event) && highest[arrays.tree.parent[event].index()] == top) event = arrays.tree.parent[event];
        return EventId(event);
    });
}

}  // namespace isoatlas
