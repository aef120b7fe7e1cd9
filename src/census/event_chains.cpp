#include "census/event_chains.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "base/paced_fill.h"

namespace isoatlas {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void lower(double& place, double value) {
    const std::atomic_ref<double> shared(place);
    double before = shared.load(std::memory_order_relaxed);
    while (value < before && !shared.compare_exchange_weak(before, value, std::memory_order_relaxed)) {
    }
}

}  // namespace

EventChains::EventChains(const Analysis& analysis) {
    const auto n = static_cast<std::size_t>(analysis.event_count());
    const EventId none(n);
    below_.items().resize(n), head_.items().resize(n), position_.items().resize(n), value_.items().resize(n + 1, -kInfinity);
    for (const EventId e : below_.ids()) {
        const Event event = analysis.event(e);
        below_[e] = event.parent.exists() ? event.parent : none;
        value_[e] = event.value;
    }
    IdArray<EventId, std::int64_t> weight(filled(n, std::int64_t{1})), length(filled(n, std::int64_t{1}));
    IdArray<EventId, EventId> heavy(filled(n, none));  // children come before their parent
    for (const EventId e : below_.ids()) {
        const EventId parent = below_[e];
        if (parent == none) continue;
        weight[parent] += weight[e];
        if (heavy[parent] != none && weight[heavy[parent]] >= weight[e]) continue;
        heavy[parent] = e;
        length[parent] = length[e] + 1;
    }
    std::int64_t next = 0;
    for (EventId e = none.previous(); e.exists(); e = e.previous()) {
        const EventId parent = below_[e];
        const bool continues = parent < none && heavy[parent] == e;
        head_[e] = continues ? head_[parent] : e;
        position_[e] = continues ? position_[parent] + 1 : next;
        if (!continues) next += length[e];
    }
}

EventId EventChains::meeting(EventId a, EventId b) const {
    // The path that contains the meeting event has the head with the larger id: ids grow towards the root.
    while (head_[a] != head_[b]) {
        EventId& other = head_[a] < head_[b] ? a : b;
        other = below(head_[other]);
    }
    return std::max(a, b);
}

void EventChains::cut_apart(std::span<const Chain> chains, std::vector<Chain>& pieces) const {
    std::vector<Chain> covered;
    for (std::size_t i = 0; i < chains.size(); ++i) {
        const Chain own = chains[i];
        covered.clear();
        for (std::size_t j = 0; j < i; ++j) {
            const EventId start = own.top == chains[j].top ? own.top : meeting(own.top, chains[j].top);
            const EventId end = std::min(own.end, chains[j].end);
            if (start < end) covered.push_back({start, end});
        }
        std::ranges::sort(covered, {}, &Chain::top);
        EventId from = own.top;  // ids ascend along a chain
        for (const Chain& part : covered) {
            if (from < part.top) pieces.push_back({from, part.top});
            from = std::max(from, part.end);
        }
        if (from < own.end) pieces.push_back({from, own.end});
    }
}

ChainMinima::ChainMinima(const EventChains& events) : events_(events), node_(2 * static_cast<std::size_t>(events.size()), kInfinity) {}

void ChainMinima::put(Chain chain, double value) {
    const std::int64_t n = events_.size();
    events_.for_ranges(chain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t low = first + n, high = last + n + 1; low < high; low /= 2, high /= 2) {
            if (low % 2 == 1) lower(node_[static_cast<std::size_t>(low++)], value);
            if (high % 2 == 1) lower(node_[static_cast<std::size_t>(--high)], value);
        }
    });
}

IdArray<EventId, double> ChainMinima::take() {
    const auto n = static_cast<std::size_t>(events_.size());
    for (std::size_t i = 2; i < 2 * n; ++i) node_[i] = std::min(node_[i], node_[i / 2]);
    IdArray<EventId, double> lowest(n);
    for (const EventId e : lowest.ids()) lowest[e] = node_[n + static_cast<std::size_t>(events_.position(e))];
    node_ = {};
    return lowest;
}

}  // namespace isoatlas
