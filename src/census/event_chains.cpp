#include "census/event_chains.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

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
    const auto none = static_cast<std::int64_t>(n);
    below_.resize(n), head_.resize(n), position_.resize(n), value_.resize(n + 1, -kInfinity);
    for (std::size_t e = 0; e < n; ++e) {
        const Event event = analysis.event(static_cast<std::int64_t>(e));
        below_[e] = event.parent < 0 ? none : event.parent;
        value_[e] = event.value;
    }
    std::vector<std::int64_t> weight(n, 1), length(n, 1), heavy(n, none);  // children come before their parent
    for (std::size_t e = 0; e + 1 < n; ++e) {
        const auto parent = static_cast<std::size_t>(below_[e]);
        weight[parent] += weight[e];
        if (heavy[parent] != none && weight[static_cast<std::size_t>(heavy[parent])] >= weight[e]) continue;
        heavy[parent] = static_cast<std::int64_t>(e);
        length[parent] = length[e] + 1;
    }
    std::int64_t next = 0;
    for (std::size_t e = n; e-- > 0;) {
        const auto parent = static_cast<std::size_t>(below_[e]);
        const bool continues = parent < n && heavy[parent] == static_cast<std::int64_t>(e);
        head_[e] = continues ? head_[parent] : static_cast<std::int64_t>(e);
        position_[e] = continues ? position_[parent] + 1 : next;
        if (!continues) next += length[e];
    }
}

std::int64_t EventChains::meeting(std::int64_t a, std::int64_t b) const {
    // The path that contains the meeting event has the head with the larger id: ids grow towards the root.
    while (head_[static_cast<std::size_t>(a)] != head_[static_cast<std::size_t>(b)]) {
        std::int64_t& other = head_[static_cast<std::size_t>(a)] < head_[static_cast<std::size_t>(b)] ? a : b;
        other = below(head_[static_cast<std::size_t>(other)]);
    }
    return std::max(a, b);
}

void EventChains::cut_apart(std::span<const Chain> chains, std::vector<Chain>& pieces) const {
    std::vector<Chain> covered;
    for (std::size_t i = 0; i < chains.size(); ++i) {
        const Chain own = chains[i];
        covered.clear();
        for (std::size_t j = 0; j < i; ++j) {
            const std::int64_t start = own.top == chains[j].top ? own.top : meeting(own.top, chains[j].top);
            const std::int64_t end = std::min(own.end, chains[j].end);
            if (start < end) covered.push_back({start, end});
        }
        std::ranges::sort(covered, {}, &Chain::top);
        std::int64_t from = own.top;  // ids ascend along a chain
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

std::vector<double> ChainMinima::take() {
    const auto n = static_cast<std::size_t>(events_.size());
    for (std::size_t i = 2; i < 2 * n; ++i) node_[i] = std::min(node_[i], node_[i / 2]);
    std::vector<double> lowest(n);
    for (std::size_t e = 0; e < n; ++e) lowest[e] = node_[n + static_cast<std::size_t>(events_.position(static_cast<std::int64_t>(e)))];
    node_ = {};
    return lowest;
}

}  // namespace isoatlas
