// The samples of a store at one isovalue: the bricks that the surface passes are read, the others are High or Low as a whole.
//
// Samples lie where they would lie in the whole volume, in a virtual array: so the kernels for volumes in memory work on them. Which bricks
// are needed:
//   1. those that the isovalue divides (low < tau <= high): afterwards all classes are known;
//   2. those with a sample next to an active cell: cells between two bricks, and normals, which look one sample further.
#pragma once

#include <memory>
#include <mutex>

#include "base/virtual_array.h"
#include "query/tau_level.h"
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
        return {.volume = {info, samples.data()}, .tau = tau, .high = level.high, .bricks = &level.bricks, .window = window};
    }
};

class StoredSamples {
public:
    virtual ~StoredSamples() = default;

    /// Classes of all samples at tau, and every sample that a surface with normals needs made present in view().
    /// Cost: the bricks that are not present yet, and writing a bit a voxel. Afterwards only words that are busy
    /// (query/busy_words.h) need be looked at.
    [[nodiscard]] virtual StoredLevel classify(double tau, const Context& context, store::IoCounters& counters) = 0;
    /// The same for the bricks of a box alone (bricks, not samples). Cost: proportional to the box.
    [[nodiscard]] virtual StoredWindow classify_window(double tau, const store::Box& bricks, store::IoCounters& counters) = 0;
    [[nodiscard]] virtual VolumeView view() const = 0;
    [[nodiscard]] virtual const store::BrickGrid& grid() const = 0;
    /// Lowest and highest sample; reads nothing.
    [[nodiscard]] virtual std::array<double, 2> range() const = 0;
    /// Any sample; reads its brick when it is not present.
    [[nodiscard]] virtual double sample(std::int64_t voxel, store::IoCounters& counters) = 0;
    /// All samples, x fastest.
    virtual void read_all(std::span<std::byte> samples, const Context& context, store::IoCounters& counters) = 0;
    /// Reads all bricks; throws Error{input} where what is said about one is not so.
    virtual void check(const Context& context) const = 0;
    /// Forgets the samples that are present.
    virtual void clear() = 0;
};

/// The store must outlive what is returned.
[[nodiscard]] std::unique_ptr<StoredSamples> stored_samples(const store::Container& store);

}  // namespace isoatlas
