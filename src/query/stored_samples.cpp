#include "query/stored_samples.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "base/prefetch.h"
#include "isoatlas/error.h"
#include "query/threshold.h"

namespace isoatlas {
namespace {

using store::Box;
using store::BrickGrid;
using store::BrickReader;
using store::IoCounters;
using store::kBrickSide;

constexpr std::int64_t kRowsAhead = 8;  // whose samples are asked for while a row is classified: they lie far apart
constexpr std::int64_t kBeside = 2;     // samples around a brick: a cell, and the neighbour that a normal looks at

/// Bits [p, p + 16) of a row of classes; positions as in HighBits.
void put_bits(std::uint64_t* row, std::int64_t p, std::uint64_t bits) {
    row[p / 64] |= bits << p % 64;
    if (p % 64 > 48) row[p / 64 + 1] |= bits >> (64 - p % 64);
}

/// Are the bits [begin, end) of a row all equal to `high`? At most 64 of them.
bool all_equal(const std::uint64_t* row, std::int64_t begin, std::int64_t end, bool high) {
    const std::int64_t w = begin / 64, skip = begin % 64;
    const std::uint64_t bits = skip == 0 ? row[w] : row[w] >> skip | row[w + 1] << (64 - skip);
    const std::uint64_t mask = ~std::uint64_t{0} >> (64 - (end - begin));
    return (bits & mask) == (high ? mask : 0);
}

/// Which of 16 samples are at least `least`, as bits.
template <class T>
std::uint64_t bits_of_samples(const T* values, T least) {
    std::array<std::uint8_t, kBrickSide> flags;
    for (std::int64_t i = 0; i < kBrickSide; ++i) flags[static_cast<std::size_t>(i)] = values[i] >= least;
    std::array<std::uint64_t, 2> eight;
    std::memcpy(eight.data(), flags.data(), sizeof eight);
    constexpr std::uint64_t kGather = 0x0102040810204080;  // bit 0 of each byte to the top byte
    return eight[0] * kGather >> 56 | eight[1] * kGather >> 56 << 8;
}

/// A box of bricks as a grid of its own.
struct Part {
    const BrickGrid& whole;
    std::array<std::int64_t, 3> first;   ///< brick
    std::array<std::int64_t, 3> origin;  ///< voxel
    BrickGrid grid;

    explicit Part(const BrickGrid& all) : Part(all, {{0, 0, 0}, all.size}) {}
    Part(const BrickGrid& all, const Box& bricks)
        : whole(all), first(bricks.begin), origin(all.box(all.brick(bricks.begin)).begin), grid(extent_of(all, bricks)) {}
    /// The number in the whole grid.
    [[nodiscard]] std::int64_t number(std::int64_t brick) const {
        const std::array<std::int64_t, 3> at = grid.place(brick);
        return whole.brick({at[0] + first[0], at[1] + first[1], at[2] + first[2]});
    }

    /// The number of a voxel of the whole in the part.
    [[nodiscard]] std::int64_t voxel(std::int64_t whole_voxel) const {
        const std::array<std::int64_t, 3> at = whole.extent.voxel(whole_voxel);
        return grid.extent.index(at[0] - origin[0], at[1] - origin[1], at[2] - origin[2]);
    }

private:
    static Extent extent_of(const BrickGrid& all, const Box& bricks) {
        const Box low = all.box(all.brick(bricks.begin)),
                  high = all.box(all.brick({bricks.end[0] - 1, bricks.end[1] - 1, bricks.end[2] - 1}));
        Extent extent = all.extent;
        for (int axis = 0; axis < 3; ++axis) extent.size[axis] = high.end[axis] - low.begin[axis];
        return extent;
    }
};

/// Is any brick around it of another class, or the grid at an end?
bool may_touch(const BrickGrid& grid, std::int64_t brick, BrickClass own, const std::vector<BrickClass>& classes) {
    const std::array<std::int64_t, 3> at = grid.place(brick);
    const std::int64_t flat = grid.extent.rank == 2 ? 0 : 1;
    for (std::int64_t z = at[2] - flat; z <= at[2] + flat; ++z) {
        for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y) {
            for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x) {
                const bool inside = x >= 0 && y >= 0 && z >= 0 && x < grid.size[0] && y < grid.size[1] && z < grid.size[2];
                const BrickClass other = inside ? classes[static_cast<std::size_t>(grid.brick({x, y, z}))] : BrickClass::low;
                if (other != own) return true;
            }
        }
    }
    return false;
}

bool is_uniform_around(const BrickGrid& grid, const HighBits& high, std::int64_t brick, bool own) {
    const Box box = grid.box(brick);
    const std::int64_t begin = std::max<std::int64_t>(box.begin[0] - kBeside + 1, 0);
    const std::int64_t end = std::min(box.end[0] + kBeside + 1, grid.extent.size[0] + 2);
    const std::int64_t flat = grid.extent.rank == 2 ? 0 : kBeside;
    for (std::int64_t z = box.begin[2] - flat; z < box.end[2] + flat; ++z) {
        for (std::int64_t y = box.begin[1] - kBeside; y < box.end[1] + kBeside; ++y) {
            if (!all_equal(high.row(y, z), begin, end, own)) return false;  // rows outside are Low
        }
    }
    return true;
}

/// Bricks that are High or Low as a whole with something else within two samples, or High at an end of the grid.
std::vector<std::int64_t> beside_surface(const HighBits& high, const BrickGrid& grid, const std::vector<BrickClass>& classes, int threads) {
    std::vector<std::uint8_t> wanted(classes.size());
    const std::int64_t layer = grid.size[0] * grid.size[1];
    for_each_block(threads, grid.size[2], [&](std::int64_t z) {
        for (std::int64_t b = z * layer; b < (z + 1) * layer; ++b) {
            const BrickClass own = classes[static_cast<std::size_t>(b)];
            if (own == BrickClass::divided || !may_touch(grid, b, own, classes)) continue;
            wanted[static_cast<std::size_t>(b)] = !is_uniform_around(grid, high, b, own == BrickClass::high);
        }
    });
    std::vector<std::int64_t> list;
    for (std::size_t b = 0; b < wanted.size(); ++b) {
        if (wanted[b]) list.push_back(static_cast<std::int64_t>(b));
    }
    return list;
}

template <class T>
class Samples final : public StoredSamples {
public:
    explicit Samples(const store::Container& store)
        : info_(store.contents().volume),
          bricks_(store),
          grid_(bricks_.grid()),
          array_(static_cast<std::size_t>(info_.extent.voxels()) * sizeof(T)),
          present_(static_cast<std::size_t>(grid_.count())) {}

    [[nodiscard]] VolumeView view() const override { return {info_, array_.data()}; }

    [[nodiscard]] StoredLevel classify(double tau, const Context& context, IoCounters& counters) override {
        if (!std::isfinite(tau)) {
            throw Error(ErrorKind::usage, {.what = "the isovalue is not a finite number", .next = "give a finite isovalue"});
        }
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        return classify_part(Part(grid_), threshold, context.threads, counters).level;
    }

    [[nodiscard]] const BrickGrid& grid() const override { return grid_; }

    [[nodiscard]] StoredWindow classify_window(double tau, const Box& bricks, IoCounters& counters) override {
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        const Part part(grid_, bricks);
        Classified classified = classify_part(part, threshold, 1, counters);
        StoredWindow result{info_, {info_.extent, part.origin}, {}, std::move(classified.level)};
        result.info.extent = part.grid.extent;
        result.samples.resize(static_cast<std::size_t>(part.grid.extent.voxels()) * sizeof(T));
        for (const std::int64_t b : classified.needed) copy_brick(b, part, reinterpret_cast<T*>(result.samples.data()));
        return result;
    }

    [[nodiscard]] std::array<double, 2> range() const override {
        T low = bricks_.low(0), high = bricks_.high(0);
        for (std::int64_t b = 1; b < grid_.count(); ++b) low = std::min(low, bricks_.low(b)), high = std::max(high, bricks_.high(b));
        return {static_cast<double>(low), static_cast<double>(high)};
    }

    [[nodiscard]] double sample(std::int64_t voxel, IoCounters& counters) override {
        const std::lock_guard lock(mutex_);
        const std::array<std::int64_t, 3> at = info_.extent.voxel(voxel);
        load({grid_.brick({at[0] / kBrickSide, at[1] / kBrickSide, at[2] / kBrickSide})}, 1, counters);
        return static_cast<double>(samples()[voxel]);
    }

    void read_all(std::span<std::byte> out, const Context& context, IoCounters& counters) override {
        std::vector<std::int64_t> all(static_cast<std::size_t>(grid_.count()));
        for (std::size_t b = 0; b < all.size(); ++b) all[b] = static_cast<std::int64_t>(b);
        T* to = reinterpret_cast<T*>(out.data());
        counters +=
            bricks_.read(std::move(all), context.threads, [&](std::int64_t brick, std::span<const T> values) { place(brick, values, to); });
    }

    void check(const Context& context) const override { bricks_.check(context.threads); }

    void clear() override {
        const std::lock_guard lock(mutex_);
        array_.clear();
        std::fill(present_.begin(), present_.end(), std::uint8_t{0});
    }

private:
    [[nodiscard]] T* samples() { return reinterpret_cast<T*>(array_.data()); }

    void place(std::int64_t brick, std::span<const T> values, T* to) const {
        const Box box = grid_.box(brick);
        const T* from = values.data();
        const auto bytes = static_cast<std::size_t>(box.size(0)) * sizeof(T);
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y, from += box.size(0))
                std::memcpy(to + info_.extent.index(box.begin[0], y, z), from, bytes);
        }
    }

    void load(std::vector<std::int64_t> wanted, int threads, IoCounters& counters) {
        std::erase_if(wanted, [this](std::int64_t b) { return present_[static_cast<std::size_t>(b)] != 0; });
        counters +=
            bricks_.read(wanted, threads, [this](std::int64_t brick, std::span<const T> values) { place(brick, values, samples()); });
        for (const std::int64_t b : wanted) present_[static_cast<std::size_t>(b)] = 1;
    }

    [[nodiscard]] BrickClass class_of(std::int64_t brick, const Threshold<T>& threshold) const {
        if (threshold.none_high || bricks_.high(brick) < threshold.least) return BrickClass::low;
        return bricks_.low(brick) >= threshold.least ? BrickClass::high : BrickClass::divided;
    }

    struct Classified {
        StoredLevel level;
        std::vector<std::int64_t> needed;  ///< bricks whose samples a surface with normals needs; they are present
    };

    Classified classify_part(const Part& part, const Threshold<T>& threshold, int threads, IoCounters& counters) {
        LevelBricks around = bricks_of(part, threshold);
        HighBits bits(around);
        Classified result{{std::move(bits), std::move(around)}, {}};
        auto& [high, bricks] = result.level;
        for (std::int64_t b = 0; b < part.grid.count(); ++b) {
            if (bricks.classes[b] == BrickClass::divided) result.needed.push_back(part.number(b));
        }
        load(result.needed, threads, counters);
        fill(high, part, bricks.classes, threshold.least, threads);
        for (const std::int64_t b : beside_surface(high, part.grid, bricks.classes, threads)) result.needed.push_back(part.number(b));
        load(result.needed, threads, counters);
        return result;
    }

    /// What the numbers of the bricks say.
    [[nodiscard]] LevelBricks bricks_of(const Part& part, const Threshold<T>& threshold) const {
        const auto count = static_cast<std::size_t>(part.grid.count());
        LevelBricks bricks{part.grid, std::vector<BrickClass>(count), std::vector<Extremum>(count), std::vector<Extremum>(count)};
        for (std::int64_t b = 0; b < part.grid.count(); ++b) {
            const std::int64_t brick = part.number(b);
            bricks.classes[b] = class_of(brick, threshold);
            if (bricks.classes[b] != BrickClass::low)
                bricks.highest[b] = {part.voxel(bricks_.highest_voxel(brick)), static_cast<double>(bricks_.high(brick))};
            if (bricks.classes[b] != BrickClass::high)
                bricks.lowest[b] = {part.voxel(bricks_.lowest_voxel(brick)), static_cast<double>(bricks_.low(brick))};
        }
        return bricks;
    }

    void copy_brick(std::int64_t brick, const Part& part, T* to) {
        const Box box = grid_.box(brick);
        const auto bytes = static_cast<std::size_t>(box.size(0)) * sizeof(T);
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
                const std::int64_t at = part.grid.extent.index(box.begin[0] - part.origin[0], y - part.origin[1], z - part.origin[2]);
                std::memcpy(to + at, samples() + info_.extent.index(box.begin[0], y, z), bytes);
            }
        }
    }

    void fill(HighBits& high, const Part& part, const std::vector<BrickClass>& classes, T least, int threads) {
        const BrickGrid& grid = part.grid;
        for_each_block(threads, grid.size[1] * grid.size[2], [&](std::int64_t row_of_bricks) {
            const std::int64_t first = row_of_bricks * grid.size[0];
            const Box box = grid.box(first);
            std::vector<std::uint64_t> whole(static_cast<std::size_t>(high.words() + 1));
            std::vector<std::int64_t> divided;
            for (std::int64_t i = 0; i < grid.size[0]; ++i) {
                if (classes[first + i] == BrickClass::high) put_bits(whole.data(), i * kBrickSide + 1, ones(grid, i));
                if (classes[first + i] == BrickClass::divided) divided.push_back(i);
            }
            for (std::int64_t i = 0; i < box.size(1) * box.size(2); ++i) {
                const auto values_at = [&](std::int64_t row) {
                    const std::int64_t y = box.begin[1] + row % box.size(1), z = box.begin[2] + row / box.size(1);
                    return samples() + info_.extent.index(part.origin[0], y + part.origin[1], z + part.origin[2]);
                };
                const T *values = values_at(i), *later = values_at(i + kRowsAhead);
                std::uint64_t* row = high.row(box.begin[1] + i % box.size(1), box.begin[2] + i / box.size(1));
                std::copy(whole.begin(), whole.end(), row);
                for (const std::int64_t x : divided) {
                    prefetch(later + x * kBrickSide);
                    fill_brick(row, values, grid, x, least);
                }
            }
        });
    }

    /// A bit for every sample of a row of brick i of an axis.
    static std::uint64_t ones(const BrickGrid& grid, std::int64_t i) {
        return 0xffff >> (kBrickSide - std::min(kBrickSide, grid.extent.size[0] - i * kBrickSide));
    }

    static void fill_brick(std::uint64_t* row, const T* values, const BrickGrid& grid, std::int64_t i, T least) {
        const std::int64_t begin = i * kBrickSide, count = std::min(kBrickSide, grid.extent.size[0] - begin);
        std::uint64_t bits = 0;
        if (count == kBrickSide) {
            bits = bits_of_samples(values + begin, least);
        } else {
            for (std::int64_t x = 0; x < count; ++x) bits |= std::uint64_t{values[begin + x] >= least} << x;
        }
        put_bits(row, begin + 1, bits);  // position p is voxel p - 1
    }

    VolumeInfo info_;
    BrickReader<T> bricks_;
    const BrickGrid& grid_;
    VirtualArray array_;
    std::vector<std::uint8_t> present_;
    std::mutex mutex_;
};

}  // namespace

std::unique_ptr<StoredSamples> stored_samples(const store::Container& store) {
    return visit_type(store.contents().volume.type,
                      [&]<class T>(T) -> std::unique_ptr<StoredSamples> { return std::make_unique<Samples<T>>(store); });
}

}  // namespace isoatlas
