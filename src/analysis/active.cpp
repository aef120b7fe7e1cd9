// Accessors of include/isoatlas/active.h.
#include "isoatlas/active.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "analysis/active_index.h"
#include "base/cancel.h"
#include "field/order.h"
#include "field/require_isovalue.h"
#include "isoatlas/environment.h"

namespace isoatlas {

struct ActiveIndex::Data {
    virtual ~Data() = default;
    [[nodiscard]] virtual ActiveObjects at(double tau, const ActiveOptions& options, const Context& context) const = 0;
    [[nodiscard]] virtual ObjectChanges changes(double high, double low, bool all) const = 0;
    [[nodiscard]] virtual std::int64_t object_of(const VoxelValue& maximum, double tau) const = 0;
    [[nodiscard]] virtual std::optional<std::int64_t> cavity_of(const VoxelValue& minimum, double tau) const = 0;
    [[nodiscard]] virtual std::optional<double> event_below(double tau) const = 0;
    [[nodiscard]] virtual std::optional<double> event_above(double tau) const = 0;
};

namespace {

constexpr std::size_t kBetweenLooks = 4096;  // objects

/// A store whose checksums are right can still hold trees that no volume has.
[[noreturn]] void contradiction() {
    throw Error(ErrorKind::input, {.where = "trees", .what = "they are inconsistent", .next = "build the store again from the volume"});
}

template <class Number>
class Answers final : public ActiveIndex::Data {
public:
    using Element = ElementIdOf<Number>;
    using Event = EventIdOf<Number>;

    Answers(const AnalysisArrays<Number>& arrays, const Extent& extent) : zones_(arrays), extent_(extent) {}

    [[nodiscard]] ActiveObjects at(double tau, const ActiveOptions& options, const Context& context) const override {
        const std::vector<Event> active = zones_.zones(zones_.rank(tau));
        ActiveObjects all;
        all.tau = tau;
        for (const Event event : active) {
            if (all.objects.size() % kBetweenLooks == 0) stop_if_cancelled(context);
            all.objects.push_back(object(event, tau, options));
        }
        std::vector<std::size_t> order(active.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto key = [&](std::size_t i) { return std::tuple(-all.objects[i].max_voxels, all.objects[i].id); };
        std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return key(p) < key(q); });
        std::vector<ActiveObject> sorted;
        for (const std::size_t i : order) sorted.push_back(all.objects[i]);
        all.objects = std::move(sorted);
        for (const ActiveObject& object : all.objects) all.contour_count += object.contours;
        if (options.contours) list_contours(active, order, all);
        return all;
    }

    [[nodiscard]] ObjectChanges changes(double high, double low, bool all) const override {
        const std::size_t upper_rank = zones_.rank(high), lower_rank = zones_.rank(low);
        const std::vector<Event> upper = zones_.zones(upper_rank), lower = zones_.zones(lower_rank);
        ObjectChanges changes;
        changes.events = static_cast<std::int64_t>(lower_rank - upper_rank);
        std::vector<ObjectChanges::Group> groups;
        for (const Event event : lower) groups.push_back({id_of(event), {}, true});
        for (const Event event : upper) {
            const Event below = zones_.zone_at(event, lower_rank);
            ObjectChanges::Group& group = groups[position(lower, below)];
            group.upper.push_back(id_of(event));
            if (event == below) group.changes = false;
        }
        for (ObjectChanges::Group& group : groups) {
            changes.appeared += group.upper.empty();
            changes.merged += group.upper.empty() ? 0 : static_cast<std::int64_t>(group.upper.size()) - 1;
            std::sort(group.upper.begin(), group.upper.end());
            if (all || group.changes) changes.groups.push_back(std::move(group));
        }
        std::sort(changes.groups.begin(), changes.groups.end(), [](const auto& p, const auto& q) { return p.lower < q.lower; });
        return changes;
    }

    [[nodiscard]] std::int64_t object_of(const VoxelValue& maximum, double tau) const override {
        const Element element = element_of(maximum, 0);
        if (element.index() >= zones_.element_rank(tau)) contradiction();
        return id_of(zones_.zone_at(zones_.arrays().tree.event_of_element[element], zones_.rank(tau)));
    }

    [[nodiscard]] std::optional<std::int64_t> cavity_of(const VoxelValue& minimum, double tau) const override {
        const Element element = element_of(minimum, 1);
        const std::size_t rank = zones_.element_rank(tau);
        if (element.index() < rank) contradiction();
        const Element lowest = zones_.lowest_with(element, rank);
        if (lowest.index() == zones_.arrays().code.size()) return std::nullopt;
        return voxel(lowest);
    }

    [[nodiscard]] std::optional<double> event_below(double tau) const override {
        const std::size_t rank = zones_.rank(tau);
        if (rank == zones_.events()) return std::nullopt;
        return zones_.value(Event(rank));
    }

    [[nodiscard]] std::optional<double> event_above(double tau) const override {
        const std::size_t rank = zones_.rank(tau);
        const std::size_t before = rank == 0 ? 0 : zones_.rank(zones_.value(Event(rank - 1)), true);
        if (before == 0) return std::nullopt;
        return zones_.value(Event(before - 1));
    }

private:
    [[nodiscard]] std::int64_t voxel(Element element) const { return ElementCode{zones_.arrays().code[element]}.index(); }
    /// The critical voxel with so many objects just above it.
    [[nodiscard]] Element element_of(const VoxelValue& sample, int h0) const {
        const std::size_t first = zones_.element_rank(sample.value, true), end = zones_.element_rank(sample.value);
        for (const Element e : IdRange<Element>(Element(first), Element(end))) {
            const ElementCode code{zones_.arrays().code[e]};
            if (code.kind() == CodeKind::vertex && code.index() == sample.voxel && code.h0() == h0) return e;
        }
        contradiction();
    }
    [[nodiscard]] std::int64_t id_of(Event event) const { return voxel(zones_.arrays().tree.top[zones_.highest(event)]); }
    static std::size_t position(const std::vector<Event>& sorted, Event event) {
        const auto found = std::lower_bound(sorted.begin(), sorted.end(), event);
        if (found == sorted.end() || *found != event) contradiction();
        return static_cast<std::size_t>(found - sorted.begin());
    }

    [[nodiscard]] ActiveObject object(Event event, double tau, const ActiveOptions& options) const {
        const AnalysisArrays<Number>& arrays = zones_.arrays();
        const bool root = arrays.tree.is_root(event);
        ActiveObject object{};
        object.id = id_of(event);
        object.event = EventId(event);
        object.zone = {root ? -std::numeric_limits<double>::infinity() : zones_.value(arrays.tree.parent[event]), zones_.value(event), 0};
        object.above = zones_.value(zones_.largest_child(event));
        object.contours = static_cast<std::int64_t>(arrays.measures.contours[event]);
        object.chi = arrays.measures.chi[event];
        object.b2 = extent_.rank == 3 ? object.contours - 1 : 0;
        object.b1 = 1 + object.b2 - object.chi;
        object.first_contour = -1;
        object.max_voxels = extent_.voxels();
        if (!zones_.counts_voxels()) return object;
        object.zone.voxels = static_cast<std::int64_t>(arrays.voxels[event]);
        object.max_voxels = zones_.object_voxels(event);
        // Between the low end of the zone and tau no whole number: no sample.
        const bool known = options.integer_samples && std::ceil(tau) - 1 <= object.zone.tau_low;
        object.min_voxels = known ? object.max_voxels : object.max_voxels - object.zone.voxels;
        return object;
    }

    /// A contour and the position of its object's event in the list of active ones.
    using Found = std::pair<std::size_t, ActiveContour>;

    [[nodiscard]] std::vector<Found> find_contours(const std::vector<Event>& active, double tau) const {
        const std::size_t rank = zones_.element_rank(tau), event_rank = zones_.rank(tau);
        const AnalysisArrays<Number>& arrays = zones_.arrays();
        std::vector<Found> found;
        zones_.for_contours(rank, [&](Element arc) {
            const Event event = zones_.zone_at(arrays.tree.event_of_element[arrays.contours.upper(arc)], event_rank);
            const std::int64_t object = id_of(event), genus = 1 - static_cast<std::int64_t>(arrays.contours.half_chi[arc]);
            const bool outer = zones_.is_outer(arc);
            const std::int64_t id = outer ? object : voxel(zones_.lowest(arc, rank));
            found.push_back({position(active, event), {id, object, outer ? Shell::outer : Shell::inner, genus}});
        });
        return found;
    }

    /// order: objects[i] is of the event active[order[i]].
    void list_contours(const std::vector<Event>& active, const std::vector<std::size_t>& order, ActiveObjects& all) const {
        std::vector<Found> found = find_contours(active, all.tau);
        if (static_cast<std::int64_t>(found.size()) != all.contour_count) contradiction();
        std::vector<std::size_t> place(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
        for (Found& contour : found) contour.first = place[contour.first];
        std::sort(found.begin(), found.end(), [](const Found& p, const Found& q) {
            return std::tuple(p.first, p.second.shell, p.second.id) < std::tuple(q.first, q.second.shell, q.second.id);
        });
        for (const auto& [object, contour] : found) {
            std::int64_t& first = all.objects[object].first_contour;
            if (first < 0) first = static_cast<std::int64_t>(all.contours.size());
            all.contours.push_back(contour);
        }
    }

    ActiveZones<Number> zones_;
    Extent extent_;
};

// clang 19 does not instantiate what is used only inside a generic lambda.
template class Answers<std::uint32_t>;
template class Answers<std::uint64_t>;

}  // namespace

ActiveIndex::ActiveIndex(const Analysis& analysis)
    : data_(analysis.data().visit([&]<class Number>(const IndexedArrays<Number>& held) -> std::unique_ptr<Data> {
          return std::make_unique<Answers<Number>>(held.arrays, analysis.extent());
      })) {}
ActiveIndex::ActiveIndex(ActiveIndex&&) noexcept = default;
ActiveIndex& ActiveIndex::operator=(ActiveIndex&&) noexcept = default;
ActiveIndex::~ActiveIndex() = default;

ActiveObjects ActiveIndex::at(double tau, const ActiveOptions& options, const Context& context) const {
    const EnvironmentScope scope(context);
    require_isovalue(tau);
    return data_->at(tau, options, context);
}

ObjectChanges ActiveIndex::changes(double tau, double other_tau, bool all) const {
    require_isovalue(tau);
    require_isovalue(other_tau);
    return data_->changes(std::max(tau, other_tau), std::min(tau, other_tau), all);
}

std::int64_t ActiveIndex::object_of(const VoxelValue& maximum, double tau) const {
    require_isovalue(tau);
    return data_->object_of(maximum, tau);
}

std::optional<std::int64_t> ActiveIndex::cavity_of(const VoxelValue& minimum, double tau) const {
    require_isovalue(tau);
    return data_->cavity_of(minimum, tau);
}

std::optional<double> ActiveIndex::event_below(double tau) const { return data_->event_below(tau); }
std::optional<double> ActiveIndex::event_above(double tau) const { return data_->event_above(tau); }

}  // namespace isoatlas
