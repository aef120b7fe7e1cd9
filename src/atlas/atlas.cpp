#include "isoatlas/atlas.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "atlas/object_window.h"
#include "critical/bodies.h"
#include "mesh/extract_level.h"
#include "query/cut_level.h"
#include "query/stored_samples.h"
#include "store/checksum.h"
#include "store/container.h"
#include "store/tree_arrays.h"

namespace isoatlas {
namespace {

/// The number of a voxel of a window in it.
std::int64_t local_voxel(const StoredWindow& window, std::int64_t voxel) {
    const std::array<std::int64_t, 3> at = window.window.whole.voxel(voxel), &origin = window.window.origin;
    return window.info.extent.index(at[0] - origin[0], at[1] - origin[1], at[2] - origin[2]);
}

std::int64_t whole_voxel(const StoredWindow& window, std::int64_t voxel) {
    const std::array<std::int64_t, 3> at = window.info.extent.voxel(voxel), &origin = window.window.origin;
    return window.window.whole.index(at[0] + origin[0], at[1] + origin[1], at[2] + origin[2]);
}

}  // namespace

struct Atlas::Data {
    store::Container store;
    std::unique_ptr<StoredSamples> samples;
    mutable std::mutex mutex;
    store::IoCounters reads;

    explicit Data(const std::string& path) : store(path), samples(stored_samples(store)) {}

    void count(const store::IoCounters& counters) {
        const std::lock_guard lock(mutex);
        reads += counters;
    }

    /// One object from its own part of the store; nothing when the whole is cheaper, or the voxel lies in no object.
    std::optional<Surface> extract_object(double tau, ExtractOptions options, const Context& context) {
        store::IoCounters counters;
        const double height = tunnel_height_of(options.interpolant, options.tunnel_height);
        const std::optional<StoredWindow> window = window_of_object(*samples, options.objects[0], tau, height, context, counters);
        count(counters);
        if (!window) return std::nullopt;
        options.objects = {local_voxel(*window, options.objects[0])};
        Surface surface = extract_level(window->at(tau), options, context);
        for (std::vector<std::int64_t>* ids : {&surface.object, &surface.contour}) {
            for (std::int64_t& id : *ids) id = whole_voxel(*window, id);
        }
        return surface;
    }

    /// Runs query(level).
    template <class Query>
    auto at_level(double tau, const Context& context, Query&& query) {
        store::IoCounters counters;
        const StoredLevel level = samples->classify(tau, context, counters);
        const auto sample = [&](std::int64_t voxel) { return samples->sample(voxel, counters); };
        auto answer = query(TauLevel{samples->view(), tau, level.high, &level.bricks, {}, sample});
        count(counters);
        return answer;
    }
};

bool is_atlas(const std::string& path) try {
    const std::unique_ptr<File> file = io::open_file(path);
    std::array<std::byte, sizeof store::kMagic> first{};
    const std::size_t got = io::read_available(*file, path, 0, first);
    return store::begins_like_a_store(std::span(first).first(got));
} catch (const Error&) {
    return false;
}

Atlas::Atlas(const std::string& path) : data_(std::make_unique<Data>(path)) {}
Atlas::Atlas(Atlas&&) noexcept = default;
Atlas& Atlas::operator=(Atlas&&) noexcept = default;
Atlas::~Atlas() = default;

const VolumeInfo& Atlas::info() const { return data_->store.contents().volume; }
Interpolant Atlas::interpolant() const { return data_->store.contents().parameters.interpolant; }
double Atlas::tunnel_height() const { return data_->store.contents().parameters.tunnel_height; }

Cut Atlas::cut(double tau, const CutOptions& options, const Context& context) const {
    CutOptions own = options;
    own.interpolant = interpolant(), own.tunnel_height = tunnel_height();
    return data_->at_level(tau, context, [&](const TauLevel& level) { return cut_level(level, own, context); });
}

Surface Atlas::extract(double tau, const ExtractOptions& options, const Context& context) const {
    ExtractOptions own = options;
    own.interpolant = interpolant(), own.tunnel_height = tunnel_height();
    if (own.objects.size() == 1 && own.contours.empty() && std::isfinite(tau)) {
        std::optional<Surface> surface = data_->extract_object(tau, own, context);
        if (surface) return std::move(*surface);
    }
    return data_->at_level(tau, context, [&](const TauLevel& level) { return extract_level(level, own, context); });
}

Analysis Atlas::analysis() const { return store::analysis_of(data_->store, 0); }

Volume Atlas::volume(const Context& context) const {
    Volume volume = make_volume(info().extent, info().type, info().geometry);
    volume.info = info();
    store::IoCounters counters;
    data_->samples->read_all(volume.bytes, context, counters);
    data_->count(counters);
    return volume;
}

std::array<double, 2> Atlas::range() const { return data_->samples->range(); }
std::int64_t Atlas::file_bytes() const { return data_->store.file_size(); }

Volume Atlas::check(const Context& context) const {
    data_->store.check_all();
    data_->samples->check(context);
    Volume samples = volume(context);
    if (store::checksum(samples.bytes) != data_->store.contents().parameters.samples_checksum) {
        throw Error(ErrorKind::input, {.file = data_->store.path(),
                                       .where = "volume/data",
                                       .what = "the samples are not those that the store was made of",
                                       .next = "build it again from the volume"});
    }
    return samples;
}

AtlasReads Atlas::reads() const {
    const std::lock_guard lock(data_->mutex);
    return {data_->reads.bytes, data_->reads.extents, data_->reads.bricks};
}

void Atlas::clear_cache() const { data_->samples->clear(); }

}  // namespace isoatlas
