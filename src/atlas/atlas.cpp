#include "isoatlas/atlas.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "analysis/analysis_data.h"
#include "atlas/access.h"
#include "atlas/census_arrays.h"
#include "atlas/object_arrays.h"
#include "atlas/object_window.h"
#include "atlas/stored_hierarchy.h"
#include "atlas/tree_arrays.h"
#include "base/lazy.h"
#include "bricks/bricks_in_view.h"
#include "bricks/stored_samples.h"
#include "census/level_census.h"
#include "codec/checksum.h"
#include "critical/bodies.h"
#include "field/negate.h"
#include "isoatlas/environment.h"
#include "levelset/cut_level.h"
#include "mesh/extract_level.h"
#include "octree_front/front_level.h"
#include "store/container.h"

namespace isoatlas {
namespace {

/// The number of a voxel of a window in it.
std::int64_t local_voxel(const StoredWindow& window, std::int64_t voxel) {
    return window.info.extent.index(window.window.whole.voxel(voxel) - window.window.origin);
}

std::int64_t whole_voxel(const StoredWindow& window, std::int64_t voxel) {
    return window.window.whole.index(window.info.extent.voxel(voxel) + window.window.origin);
}

/// Of a store, and not of its levels of detail.
std::unique_ptr<StoredSamples> samples_of(const Container& store, std::int64_t cache_bytes) {
    if (!store.contents().has_array("surfaces/tau")) return stored_samples(store, cache_bytes);
    throw Error(ErrorKind::input, {.file = store.path(),
                                   .what = "these are levels of detail of surfaces, not a store",
                                   .next = "open the store beside it: the same name without .lod"});
}

}  // namespace

/// Queries on the trees alone.
struct AtlasTrees {
    Analysis analysis;
    ActiveIndex active;

    explicit AtlasTrees(Analysis made) : analysis(std::move(made)), active(analysis) {}
};

struct Atlas::Data {
    Container store;
    std::unique_ptr<StoredSamples> samples;
    Lazy<std::shared_ptr<const AtlasTrees>> trees;
    Lazy<LevelCensus> census;
    Lazy<ObjectTable> objects;
    mutable std::mutex mutex;
    IoCounters reads;

    Data(const std::string& path, const AtlasOptions& options)
        : store(path, options.polarity, options.corrections), samples(samples_of(store, options.cache_bytes)) {}

    [[nodiscard]] std::shared_ptr<const AtlasTrees> shared_trees() const {
        return trees.get([this] { return std::make_shared<const AtlasTrees>(analysis_of(store, {})); });
    }
    [[nodiscard]] const AtlasTrees& trees_now() const { return *shared_trees(); }

    void count(const IoCounters& counters) {
        const std::lock_guard lock(mutex);
        reads += counters;
    }
    /// cost: may be null.
    void count(const LevelQuery& spent, std::int64_t active, QueryCost* cost) {
        count(spent);
        if (cost == nullptr) return;
        QueryCost query;
        query.bytes = spent.bytes, query.extents = spent.extents, query.bricks = spent.bricks;
        query.cells_loaded = spent.samples, query.cells_visited = spent.visited, query.cells_active = active;
        *cost += query;
    }

    /// One object from its own part of the store, by extract(level, options, active), which returns the surface; nullopt when the whole is
    /// cheaper, or the voxel lies in no object.
    template <class Extract>
    std::optional<Surface> extract_object(double tau, ExtractOptions options, const Context& context, QueryCost* cost, Extract&& extract,
                                          BrickFlags& bricks) {
        LevelQuery spent;
        const double height = tunnel_height_of(options.interpolant, options.tunnel_height);
        std::vector<std::int64_t>& chosen = options.surface.objects;
        const bool is_alone = !wanted_objects(options.surface).empty();
        ObjectPart part = part_of_object(*samples, chosen[0], tau, height, is_alone, context, spent);
        const std::optional<StoredWindow>& window = part.window;
        if (!window) {
            count(spent, 0, cost);
            bricks = std::move(part.bricks);
            return std::nullopt;
        }
        chosen = {local_voxel(*window, chosen[0])};
        std::int64_t active = 0;
        Surface surface = extract(window->at(tau), options, cost == nullptr ? nullptr : &active);
        count(spent, active, cost);
        for (Array<std::int64_t>* ids : {&surface.object, &surface.contour}) {
            for (std::int64_t& id : *ids) id = whole_voxel(*window, id);
        }
        return surface;
    }

    /// The voxels of a choice of objects, where what lies away from them does not matter; empty: all matters.
    [[nodiscard]] std::vector<std::int64_t> wanted_objects(const SurfaceOptions& options) const {
        const std::int64_t voxels = samples->grid().extent.voxels();
        const auto is_inside = [&](std::int64_t voxel) { return voxel >= 0 && voxel < voxels; };
        const bool are_enough = options.contours.empty() && !options.ids;  // the id of a contour may be that of a Low region around others
        return are_enough && std::ranges::all_of(options.objects, is_inside) ? options.objects : std::vector<std::int64_t>{};
    }

    /// Runs query(level, active): sets the number of active cells; may be null. wanted: of wanted_objects(); bricks: theirs, if known.
    template <class Query>
    auto at_level(double tau, const std::vector<std::int64_t>& wanted, bool with_representatives, const Context& context, QueryCost* cost,
                  Query&& query, BrickFlags bricks = {}) {
        LevelQuery spent;
        std::int64_t active = 0;
        if (!wanted.empty() && bricks.empty()) bricks = samples->bricks_of_objects(tau, wanted, context, spent, kWorthGrowing).bricks;
        StoredLevel level = samples->classify(tau, bricks, context, spent);
        if (with_representatives) samples->add_extremes(level.bricks, context);
        const auto sample = [&](std::int64_t voxel) { return samples->sample(voxel, spent); };
        auto answer = query(TauLevel{samples->view(), tau, level.high, &level.bricks, {}, sample}, cost == nullptr ? nullptr : &active);
        count(spent, active, cost);
        return answer;
    }
};

namespace {

bool is_one_object(const SurfaceOptions& options) { return options.objects.size() == 1 && options.contours.empty(); }

}  // namespace

bool is_atlas(const std::string& path) try {
    const std::unique_ptr<File> file = open_file(path);
    std::array<std::byte, kBeginning> first{};
    const std::size_t got = read_available(*file, path, 0, first);
    return begins_like_a_store(std::span(first).first(got));
} catch (const Error&) {
    return false;
}

Atlas::Atlas(const std::string& path, const AtlasOptions& options) : data_(std::make_unique<Data>(path, options)) {}
Atlas::Atlas(Atlas&&) noexcept = default;
Atlas& Atlas::operator=(Atlas&&) noexcept = default;
Atlas::~Atlas() = default;

const VolumeInfo& Atlas::info() const { return data_->store.contents().volume; }
PolarityChoice Atlas::polarities() const { return data_->store.contents().polarities; }
Interpolant Atlas::interpolant() const { return data_->store.contents().parameters.interpolant; }
double Atlas::tunnel_height() const { return data_->store.contents().parameters.tunnel_height; }

Cut Atlas::cut(double tau, const AtlasCutOptions& options, const Context& context, QueryCost* cost) const {
    const EnvironmentScope scope(context);
    const CutOptions own{.interpolant = interpolant(), .tunnel_height = tunnel_height(), .label = options.label};
    return data_->at_level(tau, {}, true, context, cost, [&](const TauLevel& level, std::int64_t* active) {
        Cut cut = cut_level(level, own, context);
        if (active != nullptr) *active = cut.active_cells;
        return cut;
    });
}

Surface Atlas::extract(double tau, const SurfaceOptions& options, const Context& context, QueryCost* cost) const {
    const EnvironmentScope scope(context);
    const ExtractOptions own{.interpolant = interpolant(), .tunnel_height = tunnel_height(), .surface = options};
    const auto extract = [&](const TauLevel& level, const ExtractOptions& how, std::int64_t* active) {
        Surface surface;
        extract_level(level, how, context, surface, active);
        return surface;
    };
    BrickFlags bricks;
    if (is_one_object(options) && std::isfinite(tau)) {
        std::optional<Surface> surface = data_->extract_object(tau, own, context, cost, extract, bricks);
        if (surface) return std::move(*surface);
    }
    return data_->at_level(
        tau, data_->wanted_objects(options), needs_representatives(options), context, cost,
        [&](const TauLevel& level, std::int64_t* active) { return extract(level, own, active); }, std::move(bricks));
}

FrontSurface Atlas::extract_front(double tau, const FrontOptions& options, const SurfaceOptions& surface, const Context& context,
                                  QueryCost* cost) const {
    const EnvironmentScope scope(context);
    require_front(info(), options, surface);
    const ExtractOptions own{.interpolant = interpolant(), .tunnel_height = tunnel_height(), .surface = surface};
    const auto extract = [&](const TauLevel& level, const ExtractOptions& how, std::int64_t* active) {
        return extract_front_level(level, options, how, context, active);
    };
    BrickFlags bricks;
    if (is_one_object(surface) && std::isfinite(tau) && options.exact.empty()) {  // their places would be those of the whole
        FrontSurface front;
        std::optional<Surface> object = data_->extract_object(
            tau, own, context, cost,
            [&](const TauLevel& level, const ExtractOptions& how, std::int64_t* active) {
                front = extract(level, how, active);
                return std::move(front.surface);
            },
            bricks);
        if (object) {
            front.surface = std::move(*object);
            return front;
        }
    }
    return data_->at_level(
        tau, data_->wanted_objects(surface), needs_representatives(surface), context, cost,
        [&](const TauLevel& level, std::int64_t* active) { return extract(level, own, active); }, std::move(bricks));
}

ActiveObjects Atlas::active(double tau, bool contours, const Context& context) const {
    const EnvironmentScope scope(context);
    return active_index().at(tau, {.contours = contours, .integer_samples = !is_floating(info().type)}, context);
}

const ActiveIndex& Atlas::active_index() const { return data_->trees_now().active; }

ObjectTable Atlas::objects(const RankOptions& options, const Context& context) const {
    const EnvironmentScope scope(context);
    if (has_objects(data_->store) && (options.gate || options.selection)) {
        const ObjectTable& stored = data_->objects.get([this] { return objects_of(data_->store); });
        if (!options.selection && (is_whole(stored) || (options.top > 0 && options.top <= std::ssize(stored.entries))))
            return first_entries(stored, options.top);
        if (options.selection && is_whole(stored)) {
            if (std::optional<ObjectTable> selected = selected_entries(*this, stored, *options.selection, context))
                return first_entries(std::move(*selected), options.top);
        }
    }
    const Volume whole = volume(context);
    return rank_objects(whole, zoned_analysis_of(data_->store, whole, context), options, context);
}

CavityTable Atlas::cavities(const RankOptions& options, const Context& context) const {
    const EnvironmentScope scope(context);
    if (has_cavities(data_->store) && options.gate && !options.selection) {
        CavityTable stored = cavities_of(data_->store);
        if (is_whole(stored) || (options.top > 0 && options.top <= std::ssize(stored.entries)))
            return first_entries(std::move(stored), options.top);
    }
    const Volume whole = volume(context);
    return rank_cavities(whole, data_->trees_now().analysis, options, context);
}

BranchHierarchy Atlas::hierarchy(const Context& context) const {
    const EnvironmentScope scope(context);
    if (std::optional<BranchHierarchy> stored = stored_hierarchy(*this, context)) return std::move(*stored);
    const Volume whole = volume(context);
    return {whole, zoned_analysis_of(data_->store, whole, context), context};
}

Analysis Atlas::analysis() const { return analysis_of(data_->store, {}); }

Volume Atlas::volume(const Context& context) const {
    const EnvironmentScope scope(context);
    Volume volume = make_volume(info().extent, info().type, info().geometry);
    volume.info = info();
    IoCounters counters;
    data_->samples->read_all(volume.bytes, context, counters);
    data_->count(counters);
    return volume;
}

Volume Atlas::volume(const SamplesWanted& wanted, const Context& context, QueryCost* cost) const {
    const EnvironmentScope scope(context);
    Volume volume = make_volume(info().extent, info().type, info().geometry);
    volume.info = info();
    StoredSamples& samples = *data_->samples;
    LevelQuery spent;
    const BrickFlags bricks = bricks_in_view(samples.grid(), wanted, [&](BrickId b) { return samples.range(b); });
    samples.read_some(bricks, volume.bytes, context, spent);
    spent.visited = spent.samples;
    data_->count(spent, 0, cost);
    return volume;
}

std::vector<std::int64_t> Atlas::histogram(std::span<const double> edges, const Context& context) const {
    const EnvironmentScope scope(context);
    if (edges.size() < 2 || !std::is_sorted(edges.begin(), edges.end())) {
        throw Error(ErrorKind::usage, {.where = "edges of a histogram", .what = "not ascending", .expected = "two or more, ascending"});
    }
    IoCounters counters;
    std::vector<std::int64_t> counts = data_->samples->histogram(edges, context, counters);
    data_->count(counters);
    return counts;
}

std::array<double, 2> Atlas::range() const { return data_->samples->range(); }
std::int64_t Atlas::file_bytes() const { return data_->store.file_size(); }
int Atlas::version() const { return data_->store.version(); }
bool Atlas::is_replaceable() const { return data_->store.contents().is_replaceable; }
bool Atlas::has_present_values() const { return data_->store.contents().has_present_values(); }

Volume Atlas::check(const Context& context) const {
    const EnvironmentScope scope(context);
    data_->store.check_all();
    data_->samples->check(context);
    Volume samples = volume(context);
    const bool is_low = polarity_of(samples.info) == Polarity::low;
    if (is_low) negate_samples(samples.info.type, samples.bytes);
    const bool is_right = checksum(samples.bytes) == data_->store.contents().parameters.samples_checksum;
    if (is_low) negate_samples(samples.info.type, samples.bytes);
    if (!is_right) {
        throw Error(ErrorKind::input, {.file = data_->store.path(),
                                       .where = "volume/data",
                                       .what = "the samples differ from those that the store was built from",
                                       .next = "build it again from the volume"});
    }
    return samples;
}

AtlasReads Atlas::reads() const {
    const std::lock_guard lock(data_->mutex);
    return {data_->reads.bytes, data_->reads.extents, data_->reads.bricks};
}

void Atlas::clear_cache() const { data_->samples->clear(); }
std::int64_t Atlas::present_bytes() const { return data_->samples->present_bytes(); }

QueryCost& QueryCost::operator+=(const QueryCost& other) {
    bytes += other.bytes, extents += other.extents, bricks += other.bricks;
    cells_loaded += other.cells_loaded, cells_visited += other.cells_visited, cells_active += other.cells_active;
    return *this;
}

const Analysis& AtlasAccess::analysis(const Atlas& atlas) { return atlas.data_->trees_now().analysis; }

const LevelCensus& AtlasAccess::census(const Atlas& atlas) {
    return atlas.data_->census.get([&] { return census_of(atlas.data_->store); });
}
void AtlasAccess::keep(const Atlas& atlas, Analysis analysis) {
    (void)atlas.data_->trees.get([&] {
        analysis.data().visit([](auto& held) { release(held.arrays.zone.items()); });
        return std::make_shared<const AtlasTrees>(std::move(analysis));
    });
}
void AtlasAccess::keep(const Atlas& atlas, std::shared_ptr<const AtlasTrees> trees) {
    (void)atlas.data_->trees.get([&] { return std::move(trees); });
}
std::shared_ptr<const AtlasTrees> AtlasAccess::trees(const Atlas& atlas) { return atlas.data_->shared_trees(); }

const Container& AtlasAccess::store(const Atlas& atlas) { return atlas.data_->store; }
StoredSamples& AtlasAccess::samples(const Atlas& atlas) { return *atlas.data_->samples; }
void AtlasAccess::count(const Atlas& atlas, const LevelQuery& spent, std::int64_t active, QueryCost* cost) {
    atlas.data_->count(spent, active, cost);
}

}  // namespace isoatlas
