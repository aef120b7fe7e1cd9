#include "isoatlas/levels.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <tuple>

#include "atlas/access.h"
#include "atlas/build_folder.h"
#include "base/memory_limit.h"
#include "base/phase.h"
#include "field/voxel_positions.h"
#include "formats/common/file_access.h"
#include "geometry/vectors.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/object_names.h"
#include "isoatlas/polarity.h"
#include "level_of_detail/cluster_choice.h"
#include "levels/stored_clusters.h"
#include "mesh/extract_level.h"

namespace isoatlas {
namespace {

constexpr std::string_view kKeys = "surfaces/";
constexpr std::int64_t kTriangleBytes = 400;  ///< of memory, while its levels are made
constexpr Phase kMake = only_phase("make levels");

[[noreturn]] void refuse(const std::string& path, const char* what, const char* next) {
    throw Error(ErrorKind::input, {.file = path, .what = what, .next = next});
}

/// The surface that the levels of a key are of, without points and triangles.
Surface surface_of(const Atlas& atlas, double tau) {
    Surface surface;
    describe(surface, atlas.info(), tau, atlas.interpolant(), atlas.tunnel_height());
    return surface;
}

/// How long a voxel can be in any direction: the longest step where the axes are perpendicular, else a bound.
double longest_step_of(const Geometry& geometry) {
    const Vec3 steps = with_smallest_steps(geometry).spacing;
    return skew_of(geometry, 3) == 1 ? std::ranges::max(steps) : norm(steps);
}

std::vector<LevelsKey> keys_of(const Container& file) {
    const auto of = [&](const char* name) { return std::string(kKeys) + name; };
    if (!file.contents().has_array(of("tau")))
        refuse(file.path(), "this is no file of levels of detail", "make one with the levels of a store");
    const auto voxels = file.all<std::int64_t>(of("voxel"), "int64");
    const auto taus = file.all<double>(of("tau"), "float64");
    const auto contours = file.all<std::uint8_t>(of("is_contour"), "uint8");
    if (voxels.size() != taus.size() || contours.size() != taus.size())
        refuse(file.path(), "its list of surfaces is damaged", "delete the file and make the levels again");
    std::vector<LevelsKey> keys;
    for (std::size_t i = 0; i < taus.size(); ++i) keys.push_back({voxels[i], taus[i], contours[i] != 0});
    return keys;
}

std::vector<PackedArray> arrays_of(const std::vector<LevelsKey>& keys) {
    const auto column = [&]<class T>(const char* name, const char* type, T, const auto& value) {
        const auto numbers = std::make_shared<std::vector<T>>();
        for (const LevelsKey& key : keys) numbers->push_back(static_cast<T>(value(key)));
        return keeping(packed<T>(std::string(kKeys) + name, type, *numbers), numbers);
    };
    std::vector<PackedArray> arrays;
    arrays.push_back(column("voxel", "int64", std::int64_t{}, [](const LevelsKey& key) { return key.voxel; }));
    arrays.push_back(column("tau", "float64", double{}, [](const LevelsKey& key) { return key.tau; }));
    arrays.push_back(column("is_contour", "uint8", std::uint8_t{}, [](const LevelsKey& key) { return key.is_contour; }));
    return arrays;
}

/// The arrays of a surface of a file, read when they are written elsewhere under another number.
std::vector<PackedArray> copied(const Container& file, std::size_t number, std::size_t as) {
    const std::string prefix = surface_prefix(number);
    std::vector<PackedArray> arrays;
    for (const StoredArray& array : file.contents().arrays) {
        if (!array.name.starts_with(prefix)) continue;
        PackedArray copy{surface_prefix(as) + array.name.substr(prefix.size()), array.type, array.shape, array.block, {}, array.chunk};
        copy.feed = [&file, &array](const ByteSink& put) {
            const std::int64_t step = array.block;
            std::vector<std::byte> bytes;
            for (std::int64_t first = 0; first < array.bytes(); first += step) {
                bytes.resize(static_cast<std::size_t>(std::min(step, array.bytes() - first)));
                file.read(array, first, bytes);
                put(bytes);
            }
        };
        arrays.push_back(std::move(copy));
    }
    return arrays;
}

/// What the store says of its volume, without its arrays.
Contents contents_without_arrays(const Atlas& atlas) {
    Contents contents = AtlasAccess::store(atlas).contents();
    contents.arrays.clear();
    return contents;
}

/// Is the file about the samples of the store, with its interpolant?
void check_same(const Container& file, const Atlas& atlas) {
    const Parameters &here = AtlasAccess::store(atlas).contents().parameters, &there = file.contents().parameters;
    const auto all = [](const Parameters& p) { return std::tuple(p.samples_checksum, p.interpolant, p.tunnel_height); };
    if (all(here) != all(there) || polarity_of(file.contents().volume) != polarity_of(atlas.info()))
        refuse(file.path(), "the levels of detail are of another store", "delete the file, or move it to its store");
}

std::string part_name(const LevelsKey& key) {
    return "surface-" + std::to_string(key.voxel) + "-" + std::to_string(std::bit_cast<std::uint64_t>(key.tau)) +
           (key.is_contour ? "_wall" : "");
}

/// The contents of the part of one surface: those of another surface or store are not taken for it.
Contents contents_of_part(const Atlas& atlas, const LevelsKey& key) {
    Contents contents = contents_without_arrays(atlas);
    contents.fingerprint.add("levels of", part_name(key));
    return contents;
}

Context part_of_progress(const Context& context, std::size_t i, std::size_t count) {
    Context own = context;
    if (!context.progress) return own;
    own.progress = [told = context.progress, i, count](const Progress& progress) {
        const double fraction = (progress.phase_index + progress.fraction) / progress.phase_count;
        told({.phase = kMake.name,
              .phase_index = 0,
              .phase_count = 1,
              .fraction = (static_cast<double>(i) + fraction) / static_cast<double>(count)});
    };
    return own;
}

void make_part(const Atlas& atlas, const LevelsKey& key, const std::string& path, const std::string& scratch_folder,
               const Context& context) {
    SurfaceOptions options;
    (key.is_contour ? options.contours : options.objects) = {key.voxel};
    Surface surface = atlas.extract(key.tau, options, context);
    atlas.clear_cache();
    const std::int64_t half = available_memory() / 2;
    const MemoryLimit limit(std::ssize(surface.triangles) > half / kTriangleBytes ? half : 0, scratch_folder);
    const ClusterHierarchy hierarchy = make_clusters(std::move(surface), atlas.info().geometry, atlas.info().extent, {}, context);
    std::vector<PackedArray> arrays = arrays_of(std::vector<LevelsKey>{key});
    std::ranges::move(arrays_of(hierarchy, surface_prefix(0)), std::back_inserter(arrays));
    pack_store(path, contents_of_part(atlas, key), arrays);
}

}  // namespace

std::string levels_path(const std::string& store, Polarity polarity) {
    const std::string names = object_names_path(store, polarity);
    return names.substr(0, names.size() - std::string_view(".names.json").size()) + ".lod";
}

struct Levels::Data {
    Container file;
    std::vector<LevelsKey> keys;
    std::vector<StoredClusters> clusters;
    std::vector<PreparedLevels> surfaces;
    double longest_step;  ///< physical, of distances of a voxel

    Data(const std::string& path, const Atlas& atlas)
        : file(path), keys(keys_of(file)), longest_step(longest_step_of(atlas.info().geometry)) {
        check_same(file, atlas);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const StoredClusters& of = clusters.emplace_back(file, surface_prefix(i), surface_of(atlas, keys[i].tau));
            double distance = 0;
            for (const ClusterGroup& group : of.tables().groups) distance = std::max(distance, group.distance);
            surfaces.push_back({keys[i], triangles_within(of.tables(), 0), triangles_within(of.tables(), distance), distance});
        }
    }
    [[nodiscard]] const StoredClusters& at(std::int64_t surface) const {
        if (surface >= 0 && surface < static_cast<std::int64_t>(clusters.size())) return clusters[static_cast<std::size_t>(surface)];
        throw Error(ErrorKind::usage, {.file = file.path(),
                                       .what = "the file has no surface " + std::to_string(surface),
                                       .expected = "fewer than " + std::to_string(clusters.size())});
    }
};

std::vector<PreparedLevels> make_levels(const Atlas& atlas, const std::string& path, std::span<const LevelsKey> surfaces,
                                        const LevelsOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    if (atlas.info().extent.rank != 3) {
        throw Error(ErrorKind::unsupported, {.file = AtlasAccess::store(atlas).path(),
                                             .what = "the contours of a 2D image have no levels of detail",
                                             .next = "extract writes them as they are"});
    }
    BuildFolder folder(path, false);
    const MemoryLimit limit(options.memory, folder.path());
    std::unique_ptr<const Container> before;
    std::vector<LevelsKey> keys;
    if (file_exists(path)) {
        before = std::make_unique<const Container>(path);
        check_same(*before, atlas);
        keys = keys_of(*before);
    }
    const std::size_t held = keys.size();
    for (const LevelsKey& key : surfaces) {
        if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
    std::vector<std::unique_ptr<const Container>> parts;
    for (std::size_t i = held; i < keys.size(); ++i) {
        const std::string name = part_name(keys[i]);
        std::string why_not;
        std::unique_ptr<const Container> part = folder.finished(name, contents_of_part(atlas, keys[i]), why_not);
        if (!part) {
            make_part(atlas, keys[i], folder.file(name), folder.path(), part_of_progress(context, i - held, keys.size() - held));
            part = std::make_unique<const Container>(folder.file(name));
        }
        parts.push_back(std::move(part));
    }
    if (!parts.empty() || !before) {
        std::vector<PackedArray> arrays = arrays_of(keys);
        for (std::size_t i = 0; i < keys.size(); ++i)
            std::ranges::move(i < held ? copied(*before, i, i) : copied(*parts[i - held], 0, i), std::back_inserter(arrays));
        pack_store(path, contents_without_arrays(atlas), arrays);
    }
    parts.clear(), before.reset();
    (void)folder.remove();
    return Levels(path, atlas).surfaces();
}

Levels::Levels(const std::string& path, const Atlas& atlas) : data_(std::make_unique<Data>(path, atlas)) {}
Levels::~Levels() = default;
Levels::Levels(Levels&&) noexcept = default;
Levels& Levels::operator=(Levels&&) noexcept = default;

const std::vector<PreparedLevels>& Levels::surfaces() const { return data_->surfaces; }

std::int64_t Levels::find(const LevelsKey& key) const {
    const auto found = std::ranges::find(data_->keys, key);
    return found == data_->keys.end() ? -1 : found - data_->keys.begin();
}

SimplifiedSurface Levels::within(std::int64_t surface, double distance) const {
    const StoredClusters& clusters = data_->at(surface);
    double reached = 0;
    for (const ClusterGroup& group : clusters.tables().groups) {
        if (group.distance <= distance) reached = std::max(reached, group.distance);
    }
    return {surface_within(clusters.read(distance), distance), reached};
}

SimplifiedSurface Levels::at_most(std::int64_t surface, std::int64_t triangles) const {
    const StoredClusters& clusters = data_->at(surface);
    std::vector<double> distances{0};
    for (const ClusterGroup& group : clusters.tables().groups) distances.push_back(group.distance);
    std::ranges::sort(distances);
    const auto fits = [&](double distance) { return triangles_within(clusters.tables(), distance) <= triangles; };
    const auto found = std::ranges::partition_point(distances, [&](double distance) { return !fits(distance); });
    return within(surface, found == distances.end() ? distances.back() : *found);
}

SeenSurface Levels::seen_from(std::int64_t surface, const Viewpoint& from, double pixels, std::int64_t triangles) const {
    if (!(pixels > 0)) throw Error(ErrorKind::usage, {.what = "the number of pixels is not positive", .expected = "more than 0"});
    const StoredClusters& clusters = data_->at(surface);
    const ClusterHierarchy& tables = clusters.tables();
    const std::vector<double> of_groups = pixels_of_groups(tables, from, data_->longest_step);
    const auto chosen = [&](double most) {
        return clusters_of_choice(tables, [&](std::int64_t group) { return of_groups[static_cast<std::size_t>(group)] <= most; });
    };
    std::vector<double> steps{pixels};
    std::ranges::copy_if(of_groups, std::back_inserter(steps), [&](double of_group) { return of_group > pixels; });
    std::ranges::sort(steps);
    const auto found = std::ranges::partition_point(steps, [&](double most) { return triangles_of(tables, chosen(most)) > triangles; });
    const double most = found == steps.end() ? steps.back() : *found;
    SeenSurface seen{{clusters.read(chosen(most)), 0}, 0};
    for (std::size_t i = 0; i < of_groups.size(); ++i) {
        if (of_groups[i] > most) continue;
        seen.simplified.distance = std::max(seen.simplified.distance, tables.groups[i].distance);
        seen.pixels = std::max(seen.pixels, of_groups[i]);
    }
    return seen;
}

ClusterHierarchy Levels::hierarchy(std::int64_t surface) const { return data_->at(surface).read(-1); }

}  // namespace isoatlas
