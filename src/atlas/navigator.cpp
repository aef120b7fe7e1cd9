#include "isoatlas/navigator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "atlas/access.h"
#include "bricks/stored_samples.h"
#include "isoatlas/environment.h"
#include "mesh/extract_level.h"
#include "octree_front/front_level.h"

namespace isoatlas {

struct Navigator::Data {
    const Atlas& atlas;
    ExtractOptions options;
    KeptLevel level{};
    Surface surface{};
    std::optional<double> tau{}, before{};
    std::int64_t changed_bricks = 0;
    QueryCost cost{};
    bool active_counted = true;  ///< has `cost` the active cells of the surface?

    Data(const Atlas& from, const SurfaceOptions& how)
        : atlas(from), options{.interpolant = from.interpolant(), .tunnel_height = from.tunnel_height(), .surface = how} {}

    /// A single object is extracted from the bricks around it, independent of the previous state.
    [[nodiscard]] bool shows_one() const { return options.surface.objects.size() == 1 && options.surface.contours.empty(); }

    void begin_move() {
        before = std::exchange(tau, std::nullopt);
        cost = {}, active_counted = true;
    }

    void move(double to, const Context& context) {
        begin_move();
        if (shows_one()) {
            surface = atlas.extract(to, options.surface, context, &cost);
            changed_bricks = 0;
        } else {
            at_level(to, context, [&](const TauLevel& at, std::int64_t* active) { extract_level(at, options, context, surface, active); });
        }
        tau = to;
    }

    FrontSurface move_front(double to, const FrontOptions& front, const Context& context) {
        require_front(atlas.info(), front, options.surface);
        begin_move();
        surface = {};
        std::optional<FrontSurface> made;
        if (shows_one()) {
            made = atlas.extract_front(to, front, options.surface, context, &cost);
            changed_bricks = 0;
        } else {
            at_level(to, context,
                     [&](const TauLevel& at, std::int64_t* active) { made = extract_front_level(at, front, options, context, active); });
        }
        tau = to;
        return std::move(*made);
    }

    /// Runs extract(level, active): sets the number of active cells; may be null.
    template <class Extract>
    void at_level(double to, const Context& context, const Extract& extract) {
        LevelQuery spent;
        std::int64_t active = 0;
        StoredSamples& samples = AtlasAccess::samples(atlas);
        KeptLevel next = std::exchange(level, {});  // reset when anything throws
        changed_bricks = samples.reclassify(next, to, context, spent);
        if (needs_representatives(options.surface)) samples.add_extremes(next.level->bricks, context);
        const auto sample = [&](std::int64_t voxel) { return samples.sample(voxel, spent); };
        const bool counts = selects_components(options.surface);
        extract(TauLevel{samples.view(), to, next.level->high, &next.level->bricks, {}, sample}, counts ? &active : nullptr);
        level = std::move(next);
        active_counted = counts;
        AtlasAccess::count(atlas, spent, active, &cost);
    }

    /// Active cells of a whole surface are counted when somebody asks: a tenth of the time of a small step.
    const QueryCost& whole_cost() {
        if (!active_counted) {
            const TauLevel at{AtlasAccess::samples(atlas).view(), *tau, level.level->high, &level.level->bricks};
            cost.cells_active = count_cells(at, options.surface.boundary, {});
            active_counted = true;
        }
        return cost;
    }

    /// The shown object among the active ones; nullopt when its id is not a representative.
    [[nodiscard]] std::optional<ActiveObject> shown_object() const {
        if (!shows_one()) return std::nullopt;
        const ActiveObjects active = atlas.active(*tau, false);
        const auto found = std::find_if(active.objects.begin(), active.objects.end(),
                                        [this](const ActiveObject& object) { return object.id == options.surface.objects[0]; });
        return found == active.objects.end() ? std::nullopt : std::optional(*found);
    }

    bool move_to(std::optional<double> to, const Context& context) {
        if (!to || *to == *tau || !std::isfinite(*to)) return false;
        move(*to, context);
        return true;
    }

    void require_position() const {
        if (tau) return;
        throw Error(ErrorKind::usage, {.what = "the navigator has no isovalue yet", .next = "call go_to first"});
    }
};

Navigator::Navigator(const Atlas& atlas, const SurfaceOptions& options) : data_(std::make_unique<Data>(atlas, options)) {}
Navigator::Navigator(Navigator&&) noexcept = default;
Navigator& Navigator::operator=(Navigator&&) noexcept = default;
Navigator::~Navigator() = default;

std::optional<double> Navigator::tau() const { return data_->tau; }
const Surface& Navigator::surface() const { return data_->surface; }

const Surface& Navigator::go_to(double tau, const Context& context) {
    const EnvironmentScope scope(context);
    data_->move(tau, context);
    return data_->surface;
}

const Surface& Navigator::step(double delta, const Context& context) {
    const EnvironmentScope scope(context);
    data_->require_position();
    return go_to(*data_->tau + delta, context);
}

const Surface& Navigator::show(std::vector<std::int64_t> objects, double tau, const Context& context) {
    const EnvironmentScope scope(context);
    data_->options.surface.objects = std::move(objects);
    return go_to(tau, context);
}

FrontSurface Navigator::extract_front(double tau, const FrontOptions& front, const Context& context) {
    const EnvironmentScope scope(context);
    return data_->move_front(tau, front, context);
}

bool Navigator::to_event_below(const Context& context) {
    const EnvironmentScope scope(context);
    data_->require_position();
    const std::optional<ActiveObject> object = data_->shown_object();
    return data_->move_to(object ? object->zone.tau_low : data_->atlas.active_index().event_below(*data_->tau), context);
}

bool Navigator::to_event_above(const Context& context) {
    const EnvironmentScope scope(context);
    data_->require_position();
    const std::optional<ActiveObject> object = data_->shown_object();
    if (object && object->above == object->zone.tau_high) return false;  // it begins here
    return data_->move_to(object ? object->above : data_->atlas.active_index().event_above(*data_->tau), context);
}

ObjectChanges Navigator::changes() const {
    if (!data_->tau || !data_->before) return {};
    return data_->atlas.active_index().changes(*data_->before, *data_->tau);
}

const QueryCost& Navigator::cost() const { return data_->whole_cost(); }
std::int64_t Navigator::changed_bricks() const { return data_->changed_bricks; }

}  // namespace isoatlas
