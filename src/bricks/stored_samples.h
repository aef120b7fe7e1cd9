// The samples of a store at one isovalue: bricks that the surface intersects are read, the others are entirely High or Low.
//
// Samples are stored brick by brick in a virtual array with a slot for every brick (bricks/brick_layout.h): a brick spans one or two pages
// of memory, and kernels address samples as in a volume (field/sample_grid.h). Required bricks:
//   1. those divided by the isovalue (low < tau <= high): they determine all classes;
//   2. those with a sample next to an active cell: cells between two bricks, and normals, which read one sample further.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "bricks/brick_bits.h"
#include "bricks/brick_cache.h"
#include "levelset/tau_level.h"
#include "store/io_counters.h"

namespace isoatlas {

class Container;

/// The classes of a store at one isovalue.
struct StoredLevel {
    HighBits high;
    LevelBricks bricks;
};

/// Bricks that contain some objects and all cells around them: where all others count as Low, the surfaces of these objects are the same.
struct ObjectBricks {
    BrickFlags bricks;      ///< empty: all of them
    bool is_tight = false;  ///< as far as the objects' samples reach (bricks/region_growing.h), and not as whole bricks may join them
};

/// Samples and classes of some bricks, as a volume of its own.
struct StoredWindow {
    VolumeInfo info;
    Window window;
    std::vector<std::byte> samples;
    StoredLevel level;

    [[nodiscard]] TauLevel at(double tau) const {
        return {.volume = VolumeView(info, samples.data()), .tau = tau, .high = level.high, .bricks = &level.bricks, .window = window};
    }
};

/// Where an object lies.
struct ObjectPart {
    std::optional<StoredWindow> window;  ///< nullopt: it is most of the volume
    BrickFlags bricks{};                 ///< of ObjectBricks; empty: they are not known
};

/// The classes at an isovalue, kept for an incremental update at the next one.
struct KeptLevel {
    std::optional<StoredLevel> level{};  ///< none yet
    std::optional<double> tau{};
    BrickFlags beside{};                   ///< not divided, but its samples are needed
    IdArray<BrickId, BrickFaces> sides{};  ///< of the divided bricks
};

/// A running query: its cost and its leased bricks.
struct LevelQuery : IoCounters {
    std::int64_t visited = 0;  ///< samples of the bricks that were used, cached or not
    BrickLease held{};
};

/// Bricks that take longer to be read than rounds of reading do.
inline constexpr std::int64_t kWorthGrowing = 2048;

class StoredSamples {
public:
    virtual ~StoredSamples() = default;

    /// Classes of all samples at tau, and every sample that a surface with normals needs made present in view()
    /// as long as the query lives.
    /// Cost: the bricks that are not present yet, and writing a bit a voxel. Afterwards only candidate words (levelset/candidate_words.h)
    /// need to be processed. kept: all other bricks count as Low; empty: none does.
    [[nodiscard]] virtual StoredLevel classify(double tau, const BrickFlags& kept, const Context& context, LevelQuery& query) = 0;
    /// Of the objects at tau that contain these voxels. worth: if at least so many divided bricks may be joined with them, bricks are
    /// read, in rounds, to learn how far the objects reach, up to a third of those. The same answer whatever is present.
    [[nodiscard]] virtual ObjectBricks bricks_of_objects(double tau, const std::vector<std::int64_t>& voxels, const Context& context,
                                                         LevelQuery& query, std::int64_t worth) = 0;
    /// The same for another isovalue than that of `kept`, which is updated: only bricks with a sample between the two are reclassified.
    /// Returns their number. When it throws, `kept` must not be used again.
    virtual std::int64_t reclassify(KeptLevel& kept, double tau, const Context& context, LevelQuery& query) = 0;
    /// Brick data for representatives (levelset/component_representatives.h) at an isovalue.
    virtual void add_extremes(LevelBricks& bricks, const Context& context) const = 0;
    /// classify() for the bricks of a box alone (bricks, not samples), with all data for representatives. Cost: proportional to the box.
    [[nodiscard]] virtual StoredWindow classify_window(double tau, const Box& bricks, const BrickFlags& kept, const Context& context,
                                                       LevelQuery& query) = 0;
    /// Bounds of what classify() would read of a newly opened store: at least the divided bricks, at most also those adjacent to bricks of
    /// another class. Reads nothing.
    struct Foreseen {
        IoCounters min, max;
    };
    [[nodiscard]] virtual Foreseen foresee(double tau) const = 0;
    [[nodiscard]] virtual SampleView view() const = 0;
    [[nodiscard]] virtual const BrickGrid& grid() const = 0;
    /// Lowest and highest sample; reads nothing.
    [[nodiscard]] virtual std::array<double, 2> range() const = 0;
    /// The same of a brick.
    [[nodiscard]] virtual std::array<double, 2> range(BrickId brick) const = 0;
    /// Any sample; reads its brick when it is not present.
    [[nodiscard]] virtual double sample(std::int64_t voxel, IoCounters& counters) = 0;
    /// All samples, x fastest.
    virtual void read_all(std::span<std::byte> samples, const Context& context, IoCounters& counters) = 0;
    /// All samples of the flagged bricks; all others are the lowest sample of their brick.
    virtual void read_some(IdSpan<BrickId, const std::uint8_t> bricks, std::span<std::byte> samples, const Context& context,
                           IoCounters& counters) = 0;
    /// bricks/brick_samples.h; out: samples of the type of the store.
    virtual void read_box(const Box& box, std::int64_t step, std::span<std::byte> out, const Context& context, IoCounters& counters) = 0;
    virtual void read_means(std::int64_t step, std::int64_t layer, std::span<float> out, const Context& context, IoCounters& counters) = 0;
    /// bricks/brick_histogram.h
    [[nodiscard]] virtual std::vector<std::int64_t> histogram(std::span<const double> edges, const Context& context,
                                                              IoCounters& counters) = 0;
    /// Reads all bricks; throws Error{input} where the index of a brick is wrong.
    virtual void check(const Context& context) const = 0;
    /// Evicts all present samples that are not leased.
    virtual void clear() = 0;
    /// Memory of the present samples.
    [[nodiscard]] virtual std::int64_t present_bytes() const = 0;
};

/// The store must outlive the result. cache_bytes: memory budget of unleased samples, in pages; 0: unlimited.
[[nodiscard]] std::unique_ptr<StoredSamples> stored_samples(const Container& store, std::int64_t cache_bytes);

}  // namespace isoatlas
