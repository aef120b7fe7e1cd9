// The sweep: all cuts from high to low, one element at a time. Nothing is maintained: each cut is a new snapshot, and what an element
// did is what differs between two snapshots. Levels and events compare the contours just above a value with those just below.
#include <algorithm>
#include <map>
#include <set>

#include "oracle/oracle.h"

namespace oracle {
namespace {

/// Contours of all cuts inside one value are grouped: linked when an element between two cuts touches them.
struct Groups {
    std::vector<Index> up;
    std::vector<std::vector<Index>> critical;  // of each group root, positions in Result::critical
    Index add() {
        up.push_back(static_cast<Index>(up.size()));
        critical.emplace_back();
        return up.back();
    }
    Index find(Index x) const {
        while (up[x] != x) x = up[x];
        return x;
    }
    Index join(Index a, Index b) {
        a = find(a), b = find(b);
        if (a == b) return a;
        critical[b].insert(critical[b].end(), critical[a].begin(), critical[a].end());
        critical[a].clear();
        return up[a] = b;
    }
};

class Sweep {
public:
    explicit Sweep(const Elements& e) : elements_(e), grid_(e.grid) {}

    Result run() {
        Index rank = elements_.count();
        now_ = snapshot(elements_, rank);
        check(now_);
        while (rank > 0) {
            const double value = elements_.all[elements_.by_rank[rank - 1]].value;
            above_ = now_;
            groups_ = {};
            group_of_.clear();
            for (std::size_t c = 0; c < now_.contours.size(); ++c) group_of_.push_back(groups_.add());
            const std::vector<Index> group_above = group_of_;
            while (rank > 0 && elements_.all[elements_.by_rank[rank - 1]].value == value) pass(--rank);
            close_value(value, group_above);
        }
        finish();
        return std::move(result_);
    }

private:
    const Elements& elements_;
    const Grid& grid_;
    Result result_;
    Snapshot now_, above_;         // the current cut; the cut just above the current value
    std::vector<Index> upper_of_;  // critical element at which each contour of now_ began
    Groups groups_;
    std::vector<Index> group_of_;  // of each contour of now_
    std::vector<Index> event_of_;  // of each object of now_ at the last cut between two values

    // --- one element --------------------------------------------------------------------------------------------------------------
    void check(const Snapshot& s) {
        bool good = s.contours.size() + 1 == s.objects.size() + s.lows.size();  // T1
        std::set<std::pair<Index, Index>> pairs;
        for (const Contour& contour : s.contours) {
            good = good && contour.consistent && pairs.insert({contour.object, contour.low}).second;
            if (grid_.rank == 2) good = good && contour.hits == contour.segments;
            if (grid_.rank == 3) good = good && contour.chi() % 2 == 0 && contour.genus >= 0;
        }
        Index chi = 0;
        for (const Object& object : s.objects) chi += object.chi;
        result_.consistent = result_.consistent && good && chi == s.chi_by_cells;
    }

    /// Hits next to an element: all hits on edges at a vertex, on the edges of a face, or at both ends of the tunnel of a body point.
    std::set<Index> touched(const Snapshot& s, Index e, Index cut) const {
        std::set<Index> contours;
        const Element& element = elements_.all[e];
        const auto add = [&](Index v, int d) {
            const Index contour = s.contour_of_hit[6 * v + d];
            if (contour >= 0) contours.insert(contour);
        };
        if (element.type == Type::body) {
            for (const auto& [high, low] : elements_.edges_at_tunnel(e, cut)) {
                for (int d = 0; d < grid_.directions(); ++d) {
                    if (grid_.neighbour(high, d) == low) add(high, d);
                }
            }
            return contours;
        }
        const bool is_face = element.type == Type::face;
        for (const Index v : is_face ? std::vector<Index>(element.corner.begin(), element.corner.end()) : std::vector<Index>{e}) {
            for (int d = 0; d < grid_.directions(); ++d) {
                const Index w = grid_.neighbour(v, d);
                const bool on_face = is_face && std::find(element.corner.begin(), element.corner.end(), w) != element.corner.end();
                if (is_face && !on_face) continue;
                add(v, d);
                if (w >= 0) add(w, d ^ 1);
            }
        }
        return contours;
    }

    /// Does the element begin an object (no High neighbour above) or end a low component (no Low neighbour below)?
    bool is_alone(const Snapshot& s, Index e, bool as_high) const {
        const Element& element = elements_.all[e];
        if (element.type != Type::vertex) return false;
        for (Index other = 0; other < elements_.count(); ++other) {
            if (other == e) continue;
            if (as_high && s.object_of[other] >= 0 && s.object_of[other] == s.object_of[e]) return false;
            if (!as_high && s.low_of[other] >= 0 && s.low_of[other] == s.low_of[e]) return false;
        }
        return as_high || s.low_of[e] != 0;
    }

    /// What passing from `before` to `after` did; adds a critical element. Returns whether it was critical.
    bool classify(Index e, const Snapshot& before, const Snapshot& after) {
        const Index delta = after.chi_by_cells - before.chi_by_cells;
        const bool begins = is_alone(after, e, true), ends = is_alone(before, e, false);
        const auto objects = static_cast<Index>(after.objects.size()) - static_cast<Index>(before.objects.size());
        const auto lows = static_cast<Index>(after.lows.size()) - static_cast<Index>(before.lows.size());
        int h0 = 1, l0 = 1;
        bool good = true;
        if (begins) {
            h0 = 0, good = delta == 1 && objects == 1 && lows == 0;
        } else if (ends) {
            l0 = 0, good = delta == (grid_.rank == 2 ? 1 : -1) && objects == 0 && lows == -1;
        } else if (grid_.rank == 2 && delta == -1) {
            h0 = l0 = 2, good = objects - lows == -1;
        } else if (grid_.rank == 3 && delta == -1) {
            h0 = 2, good = lows == 0 && (objects == 0 || objects == -1);
        } else if (grid_.rank == 3 && delta == 1) {
            l0 = 2, good = objects == 0 && (lows == 0 || lows == 1);
        } else {
            good = delta == 0 && objects == 0 && lows == 0;
        }
        result_.consistent = result_.consistent && good;
        if (h0 == 1 && l0 == 1) return false;
        const Element& element = elements_.all[e];
        result_.critical.push_back({e, element.value, element.position, h0, l0, static_cast<int>(delta), element.type});
        return true;
    }

    void pass(Index rank) {
        const Index e = elements_.by_rank[rank];
        Snapshot next = snapshot(elements_, rank);
        check(next);
        const bool critical = classify(e, now_, next);
        const auto id = static_cast<Index>(result_.critical.size()) - 1;
        const std::set<Index> before = touched(now_, e, rank + 1), after = touched(next, e, rank);
        std::vector<Index> upper(next.contours.size(), -1), group(next.contours.size(), -1);
        for (std::size_t hit = 0; hit < next.contour_of_hit.size(); ++hit) {  // a contour that is not touched keeps all its hits
            const Index old = now_.contour_of_hit[hit], fresh = next.contour_of_hit[hit];
            if (old < 0 || fresh < 0 || before.count(old) != 0 || after.count(fresh) != 0) continue;
            upper[fresh] = upper_of_[old];
            group[fresh] = group_of_[old];
        }
        const Index node = groups_.add();
        for (const Index c : before) groups_.join(group_of_[c], node);
        if (critical) groups_.critical[groups_.find(node)].push_back(id);
        for (const Index c : before) {
            if (critical) close_arc(upper_of_[c], id, now_.contours[c].genus);
        }
        if (!critical) result_.consistent = result_.consistent && before.size() == 1 && after.size() == 1;
        for (const Index c : after) {
            group[c] = node;
            upper[c] = critical ? id : upper_of_[*before.begin()];
        }
        upper_of_ = std::move(upper);
        group_of_ = std::move(group);
        now_ = std::move(next);
    }

    void close_arc(Index upper, Index lower, Index genus) {
        const double high = result_.critical[upper].value, low = result_.critical[lower].value;
        if (high != low) result_.arcs.push_back({upper, lower, high, low, genus});
    }

    // --- one value ------------------------------------------------------------------------------------------------------------------
    void close_value(double value, const std::vector<Index>& group_above) {
        std::map<Index, Level> levels;  // by group
        for (std::size_t c = 0; c < group_above.size(); ++c) levels[groups_.find(group_above[c])].in.push_back(above_.contours[c].genus);
        for (std::size_t c = 0; c < group_of_.size(); ++c) levels[groups_.find(group_of_[c])].out.push_back(now_.contours[c].genus);
        std::map<Index, std::vector<Index>> lows_of;  // low components of the contours that leave a level
        for (std::size_t c = 0; c < group_of_.size(); ++c) lows_of[groups_.find(group_of_[c])].push_back(now_.contours[c].low);
        std::map<Index, std::pair<std::vector<Level>, std::set<Index>>> of_object;
        for (auto& [group, level] : levels) {
            std::sort(level.in.begin(), level.in.end());
            std::sort(level.out.begin(), level.out.end());
            if (level.in.size() == 1 && level.in == level.out) continue;
            level.value = value;
            level.top = *std::min_element(groups_.critical[group].begin(), groups_.critical[group].end());
            auto& [list, lows] = of_object[now_.object_of[result_.critical[level.top].element]];
            list.push_back(level);
            lows.insert(lows_of[group].begin(), lows_of[group].end());
        }
        std::vector<Index> event_of(now_.objects.size(), -1);
        for (Index object = 0; object < static_cast<Index>(now_.objects.size()); ++object) {
            const std::set<Index> parts = parts_above(object);
            const auto found = of_object.find(object);
            if (found == of_object.end()) {
                result_.consistent = result_.consistent && parts.size() == 1;
                event_of[object] = event_of_[*parts.begin()];
            } else {
                event_of[object] = add_event(value, object, parts, found->second.first, found->second.second);
            }
        }
        event_of_ = std::move(event_of);
        result_.zone.resize(static_cast<std::size_t>(grid_.voxels()), -1);
        for (Index v = 0; v < grid_.voxels(); ++v) {
            if (grid_.value[v] != value) continue;
            result_.zone[v] = event_of_[now_.object_of[v]];
            ++result_.events[result_.zone[v]].zone_voxels;
        }
    }

    /// Objects of the cut just above the value that have become part of this object.
    std::set<Index> parts_above(Index object) const {
        std::set<Index> parts;
        for (Index v = 0; v < grid_.voxels(); ++v) {
            if (now_.object_of[v] == object && above_.object_of[v] >= 0) parts.insert(above_.object_of[v]);
        }
        return parts;
    }

    Index add_event(double value, Index object, const std::set<Index>& parts, const std::vector<Level>& levels,
                    const std::set<Index>& lows) {
        const auto id = static_cast<Index>(result_.events.size());
        const Object& o = now_.objects[object];
        Event event;
        event.value = value;
        event.kind = kind_of(levels);
        event.lows_out = static_cast<Index>(lows.size());
        event.chi = o.chi, event.b1 = o.b1, event.b2 = o.b2;
        event.delta_chi = o.chi;
        for (const Index part : parts) {
            event.delta_chi -= above_.objects[part].chi;
            const Index child = event_of_[part];
            event.children.push_back(child);
            result_.events[child].parent = id;
            result_.events[child].tau_low = value;
            result_.events[child].object_voxels = above_.objects[part].voxels;
        }
        std::sort(event.children.begin(), event.children.end());
        for (const Index c : o.contours) event.genera.push_back(now_.contours[c].genus);
        std::sort(event.genera.begin(), event.genera.end());
        event.position = highest_critical(value, object);
        for (Level level : levels) {
            level.event = id;
            result_.levels.push_back(level);
        }
        result_.events.push_back(event);
        return id;
    }

    std::array<double, 3> highest_critical(double value, Index object) const {
        for (const CriticalElement& c : result_.critical) {
            if (c.value == value && now_.object_of[c.element] == object) return c.position;
        }
        return {};
    }

    static Kind kind_of(const Level& level) {
        const std::size_t k = level.in.size(), m = level.out.size();
        Index change = 0;
        for (const Index g : level.out) change += g;
        for (const Index g : level.in) change -= g;
        if (k == 0) return Kind::maximum;
        if (m == 0) return Kind::minimum;
        if (k >= 2 && m == 1 && change == 0) return Kind::merge;
        if (k == 1 && m >= 2 && change == 0) return Kind::split;
        if (k == 1 && m == 1) return Kind::genus;
        return Kind::complex;
    }
    static Kind kind_of(const std::vector<Level>& levels) {
        const Kind first = kind_of(levels.front());
        for (const Level& level : levels) {
            if (kind_of(level) != first) return Kind::complex;
        }
        return first;
    }

    // --- the end --------------------------------------------------------------------------------------------------------------------
    /// Events of one value were made in the order of objects; the public order is by highest critical element, descending.
    void finish() {
        for (std::size_t c = 0; c < now_.contours.size(); ++c) {
            const Index upper = upper_of_[c];
            result_.arcs.push_back(
                {upper, static_cast<Index>(result_.critical.size()), result_.critical[upper].value, -kInfinity, now_.contours[c].genus});
        }
        result_.events.back().object_voxels = grid_.voxels();
        order_events();
        std::sort(result_.levels.begin(), result_.levels.end(), [](const Level& p, const Level& q) { return p.top < q.top; });
    }

    Index position_in_critical(const Event& event) const {
        for (std::size_t i = 0; i < result_.critical.size(); ++i) {
            if (result_.critical[i].value == event.value && result_.critical[i].position == event.position) return static_cast<Index>(i);
        }
        return -1;
    }

    void order_events() {
        std::vector<std::pair<Index, Index>> order;  // (highest critical element, old id)
        for (std::size_t i = 0; i < result_.events.size(); ++i)
            order.push_back({position_in_critical(result_.events[i]), static_cast<Index>(i)});
        std::sort(order.begin(), order.end());
        std::vector<Index> renamed(order.size());
        std::vector<Event> events;
        for (std::size_t i = 0; i < order.size(); ++i) {
            renamed[order[i].second] = static_cast<Index>(i);
            events.push_back(result_.events[order[i].second]);
        }
        for (Event& event : events) {
            if (event.parent >= 0) event.parent = renamed[event.parent];
            for (Index& child : event.children) child = renamed[child];
            std::sort(event.children.begin(), event.children.end());
        }
        for (Level& level : result_.levels) level.event = renamed[level.event];
        for (Index& zone : result_.zone) zone = renamed[zone];
        result_.events = std::move(events);
    }
};

}  // namespace

Result analyse(const Elements& elements) { return Sweep(elements).run(); }

}  // namespace oracle
