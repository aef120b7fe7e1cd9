// The samples of a store at one isovalue: the bricks that the surface passes are read, the others are High or Low as a whole.
//
// Samples lie brick by brick in a virtual array that has a place for every brick (bricks/brick_layout.h): a brick touches one or two pages
// of memory, and the kernels find a sample as they find it in a volume (field/sample_grid.h). Which bricks are needed:
//   1. those that the isovalue divides (low < tau <= high): afterwards all classes are known;
//   2. those with a sample next to an active cell: cells between two bricks, and normals, which look one sample further.
#pragma once

#include <memory>
#include <mutex>

#include "bricks/brick_bits.h"
#include "bricks/brick_cache.h"
#include "levelset/tau_level.h"
#include "store/brick_reader.h"

namespace isoatlas {

/// The classes of a store at one isovalue.
struct StoredLevel {
    HighBits high;
    LevelBricks bricks;
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

/// The classes at an isovalue, kept so that those at the next one need not start anew.
struct KeptLevel {
    std::optional<StoredLevel> level{};  ///< nothing yet
    std::optional<double> tau{};
    std::vector<std::uint8_t> beside{};  ///< per brick: not divided, but its samples are needed
    std::vector<BrickFaces> sides{};     ///< of the divided bricks
};

/// A question while it is being answered: what it has cost, and the bricks that stay present for it.
struct LevelQuery : IoCounters {
    std::int64_t visited = 0;  ///< samples of the bricks that were looked at, present or not
    BrickLease held{};
};

class StoredSamples {
public:
    virtual ~StoredSamples() = default;

    /// Classes of all samples at tau, and every sample that a surface with normals needs made present in view()
    /// as long as the query lives.
    /// Cost: the bricks that are not present yet, and writing a bit a voxel. Afterwards only words that are busy
    /// (levelset/candidate_words.h) need be looked at.
    [[nodiscard]] virtual StoredLevel classify(double tau, const Context& context, LevelQuery& query) = 0;
    /// The same for another isovalue than that of `kept`, which becomes this one: only bricks with a sample between the two are classified
    /// again. Returns how many these are. When it throws, `kept` must not be used again.
    virtual std::int64_t reclassify(KeptLevel& kept, double tau, const Context& context, LevelQuery& query) = 0;
    /// What names need (levelset/component_representatives.h) of the bricks of a level.
    virtual void add_extremes(LevelBricks& bricks, const Context& context) const = 0;
    /// classify() for the bricks of a box alone (bricks, not samples), with all that names need. Cost: proportional to the box.
    [[nodiscard]] virtual StoredWindow classify_window(double tau, const Box& bricks, const Context& context, LevelQuery& query) = 0;
    /// What classify() would read of a store that was just opened: the divided bricks at least, at most also those beside bricks of
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
    [[nodiscard]] virtual std::array<double, 2> range(std::int64_t brick) const = 0;
    /// Any sample; reads its brick when it is not present.
    [[nodiscard]] virtual double sample(std::int64_t voxel, IoCounters& counters) = 0;
    /// All samples, x fastest.
    virtual void read_all(std::span<std::byte> samples, const Context& context, IoCounters& counters) = 0;
    /// Those of the flagged bricks; all others are the lowest one of their brick.
    virtual void read_some(std::span<const std::uint8_t> bricks, std::span<std::byte> samples, const Context& context,
                           IoCounters& counters) = 0;
    /// bricks/brick_samples.h; out: samples of the type of the store.
    virtual void read_box(const Box& box, std::int64_t step, std::span<std::byte> out, const Context& context, IoCounters& counters) = 0;
    virtual void read_means(std::int64_t step, std::int64_t layer, std::span<float> out, const Context& context, IoCounters& counters) = 0;
    /// bricks/brick_histogram.h
    [[nodiscard]] virtual std::vector<std::int64_t> histogram(std::span<const double> edges, const Context& context,
                                                              IoCounters& counters) = 0;
    /// Reads all bricks; throws Error{input} where what is said about one is not so.
    virtual void check(const Context& context) const = 0;
    /// Forgets the samples that are present, but for those that queries hold.
    virtual void clear() = 0;
    /// Memory of the samples that are present.
    [[nodiscard]] virtual std::int64_t present_bytes() const = 0;
};

/// The store must outlive what is returned. cache_bytes: how much memory samples may take that no query holds, in pages; 0: any.
[[nodiscard]] std::unique_ptr<StoredSamples> stored_samples(const Container& store, std::int64_t cache_bytes);

}  // namespace isoatlas
