#include "query/stored_samples.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "isoatlas/error.h"
#include "query/threshold.h"

namespace isoatlas {
namespace {

using store::Box;
using store::BrickGrid;
using store::BrickReader;
using store::IoCounters;
using store::kBrickSide;

constexpr std::int64_t kBeside = 2;  // samples around a brick: a cell, and the neighbour that a normal looks at

enum class BrickClass : std::uint8_t { low, high, divided };

/// Bits [p, p + 16) of a row of classes; positions as in HighBits.
void put_bits(std::uint64_t* row, std::int64_t p, std::uint64_t bits) {
    row[p / 64] |= bits << p % 64;
    if (p % 64 > 48) row[p / 64 + 1] |= bits >> (64 - p % 64);
}

/// Are the bits [begin, end) of a row all equal to `high`? Positions before 0 do not exist; those behind the padding are Low.
bool all_equal(const std::uint64_t* row, std::int64_t begin, std::int64_t end, bool high) {
    for (std::int64_t p = begin; p < end; ++p) {
        if ((row[p / 64] >> p % 64 & 1) != std::uint64_t{high}) return false;
    }
    return true;
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

    [[nodiscard]] HighBits classify(double tau, const Context& context, IoCounters& counters) override {
        if (!std::isfinite(tau)) {
            throw Error(ErrorKind::usage, {.what = "the isovalue is not a finite number", .next = "give a finite isovalue"});
        }
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        const std::vector<BrickClass> classes = classes_of(threshold);
        std::vector<std::int64_t> divided;
        for (std::int64_t b = 0; b < grid_.count(); ++b) {
            if (classes[static_cast<std::size_t>(b)] == BrickClass::divided) divided.push_back(b);
        }
        load(divided, context.threads, counters);
        HighBits high(info_.extent);
        if (!threshold.none_high) fill(high, classes, threshold.least, context.threads);
        load(beside_surface(high, classes, context.threads), context.threads, counters);
        return high;
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

    [[nodiscard]] std::vector<BrickClass> classes_of(const Threshold<T>& threshold) const {
        std::vector<BrickClass> classes(static_cast<std::size_t>(grid_.count()), BrickClass::low);
        if (threshold.none_high) return classes;
        for (std::int64_t b = 0; b < grid_.count(); ++b) {
            if (bricks_.high(b) < threshold.least) continue;
            classes[static_cast<std::size_t>(b)] = bricks_.low(b) >= threshold.least ? BrickClass::high : BrickClass::divided;
        }
        return classes;
    }

    /// Calls visit(first brick, y, z) for every row of samples, in blocks of rows of bricks.
    template <class Visit>
    void for_rows(int threads, Visit&& visit) const {
        for_each_block(threads, grid_.size[1] * grid_.size[2], [&](std::int64_t row) {
            const std::int64_t first = row * grid_.size[0];
            const Box box = grid_.box(first);
            for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
                for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) visit(first, y, z);
            }
        });
    }

    void fill(HighBits& high, const std::vector<BrickClass>& classes, T least, int threads) {
        for_rows(threads, [&](std::int64_t first, std::int64_t y, std::int64_t z) {
            std::uint64_t* row = high.row(y, z);
            const T* values = samples() + info_.extent.index(0, y, z);
            for (std::int64_t i = 0; i < grid_.size[0]; ++i) {
                const BrickClass brick = classes[static_cast<std::size_t>(first + i)];
                if (brick == BrickClass::low) continue;
                const std::int64_t begin = i * kBrickSide, count = std::min(kBrickSide, info_.extent.size[0] - begin);
                std::uint64_t bits = 0xffff >> (kBrickSide - count);
                if (brick == BrickClass::divided) {
                    bits = 0;
                    for (std::int64_t x = 0; x < count; ++x) bits |= std::uint64_t{values[begin + x] >= least} << x;
                }
                put_bits(row, begin + 1, bits);  // position p is voxel p - 1
            }
        });
    }

    /// Bricks that are High or Low as a whole with something else within two samples, or High at the border of the volume.
    [[nodiscard]] std::vector<std::int64_t> beside_surface(const HighBits& high, const std::vector<BrickClass>& classes,
                                                           int threads) const {
        std::vector<std::uint8_t> wanted(classes.size());
        for_each_block(threads, grid_.size[2], [&](std::int64_t z) {
            for (std::int64_t b = z * grid_.size[0] * grid_.size[1]; b < (z + 1) * grid_.size[0] * grid_.size[1]; ++b) {
                const BrickClass own = classes[static_cast<std::size_t>(b)];
                if (own == BrickClass::divided || !may_touch(b, own, classes)) continue;
                wanted[static_cast<std::size_t>(b)] = !is_uniform_around(high, b, own == BrickClass::high);
            }
        });
        std::vector<std::int64_t> list;
        for (std::size_t b = 0; b < wanted.size(); ++b) {
            if (wanted[b]) list.push_back(static_cast<std::int64_t>(b));
        }
        return list;
    }

    /// Is any brick around it of another class, or the volume at an end?
    [[nodiscard]] bool may_touch(std::int64_t brick, BrickClass own, const std::vector<BrickClass>& classes) const {
        const std::array<std::int64_t, 3> at = grid_.place(brick);
        const std::int64_t flat = info_.extent.rank == 2 ? 0 : 1;
        for (std::int64_t z = at[2] - flat; z <= at[2] + flat; ++z) {
            for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y) {
                for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x) {
                    const bool inside = x >= 0 && y >= 0 && z >= 0 && x < grid_.size[0] && y < grid_.size[1] && z < grid_.size[2];
                    const BrickClass other = inside ? classes[static_cast<std::size_t>(grid_.brick({x, y, z}))] : BrickClass::low;
                    if (other != own) return true;
                }
            }
        }
        return false;
    }

    [[nodiscard]] bool is_uniform_around(const HighBits& high, std::int64_t brick, bool own) const {
        const Box box = grid_.box(brick);
        const std::int64_t begin = std::max<std::int64_t>(box.begin[0] - kBeside + 1, 0);
        const std::int64_t end = std::min(box.end[0] + kBeside + 1, info_.extent.size[0] + 2);
        const std::int64_t flat = info_.extent.rank == 2 ? 0 : kBeside;
        for (std::int64_t z = box.begin[2] - flat; z < box.end[2] + flat; ++z) {
            for (std::int64_t y = box.begin[1] - kBeside; y < box.end[1] + kBeside; ++y) {
                if (!all_equal(high.row(y, z), begin, end, own)) return false;  // rows outside are Low
            }
        }
        return true;
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
    switch (store.contents().volume.type) {
        case ValueType::u8: return std::make_unique<Samples<std::uint8_t>>(store);
        case ValueType::i8: return std::make_unique<Samples<std::int8_t>>(store);
        case ValueType::u16: return std::make_unique<Samples<std::uint16_t>>(store);
        case ValueType::i16: return std::make_unique<Samples<std::int16_t>>(store);
        case ValueType::u32: return std::make_unique<Samples<std::uint32_t>>(store);
        case ValueType::i32: return std::make_unique<Samples<std::int32_t>>(store);
        case ValueType::f32: return std::make_unique<Samples<float>>(store);
        case ValueType::f64: break;
    }
    return std::make_unique<Samples<double>>(store);
}

}  // namespace isoatlas
