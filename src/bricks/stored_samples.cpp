#include "bricks/stored_samples.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/parallel.h"
#include "base/prefetch.h"
#include "bricks/brick_classes.h"
#include "bricks/brick_histogram.h"
#include "bricks/brick_layout.h"
#include "bricks/brick_part.h"
#include "bricks/brick_samples.h"
#include "bricks/read_progress.h"
#include "bricks/region_growing.h"
#include "field/require_isovalue.h"
#include "isoatlas/error.h"
#include "levelset/threshold.h"

namespace isoatlas {
namespace {

template <class T>
class Samples final : public StoredSamples {
public:
    Samples(const Container& store, std::int64_t cache_bytes)
        : info_(store.contents().volume),
          bricks_(store),
          grid_(bricks_.grid()),
          layout_(grid_),
          array_(static_cast<std::size_t>(layout_.samples_of_brick() * grid_.count()) * sizeof(T)),
          cache_(grid_.count(), layout_.samples_of_brick() * static_cast<std::int64_t>(sizeof(T)), array_, cache_bytes, mutex_) {}

    [[nodiscard]] SampleView view() const override { return {info_, array_.data(), layout_.by_voxel()}; }

    [[nodiscard]] StoredLevel classify(double tau, const BrickFlags& kept, const Context& context, LevelQuery& query) override {
        require_isovalue(tau);
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        return classify_part(BrickPart(grid_), bricks_of(BrickPart(grid_), threshold, context.threads, kept), threshold, context, query)
            .level;
    }

    [[nodiscard]] ObjectBricks bricks_of_objects(double tau, const std::vector<std::int64_t>& voxels, const Context& context,
                                                 LevelQuery& query, std::int64_t worth) override {
        require_isovalue(tau);
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        LevelBricks bricks = bricks_of(BrickPart(grid_), threshold, context.threads);
        std::vector<BrickId> homes;
        for (const std::int64_t voxel : voxels) homes.push_back(grid_.brick(BrickGrid::place_of(info_.extent.voxel(voxel))));
        BrickFlags joined = joined_bricks(grid_, homes, bricks.classes);
        make_others_low(BrickPart(grid_), joined, bricks.classes);
        const std::vector<BrickId> divided = divided_bricks(BrickPart(grid_), bricks);
        if (std::ssize(divided) < worth) return {std::move(joined)};
        RegionGrowing region(grid_, bricks.classes);
        for (const std::int64_t voxel : voxels) region.seed(info_.extent.voxel(voxel));
        if (!read_region(region, std::ssize(divided) / 3, threshold.min, context, query)) return {std::move(joined)};
        return {region.touched(), true};
    }

    std::int64_t reclassify(KeptLevel& kept, double tau, const Context& context, LevelQuery& query) override {
        require_isovalue(tau);
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        const std::optional<double> before = std::exchange(kept.tau, tau);
        LevelBricks bricks = bricks_of(BrickPart(grid_), threshold, context.threads);
        if (!kept.level) return classify_anew(kept, std::move(bricks), threshold, context, query);
        const std::vector<BrickId> divided = divided_bricks(BrickPart(grid_), bricks);
        const BrickFlags changed = bricks_between(threshold_for<T>(*before), threshold);
        const std::int64_t changes = std::ranges::count(changed.items(), std::uint8_t{1});
        if (changes > std::ssize(divided)) return classify_anew(kept, std::move(bricks), threshold, context, query);  // less work
        auto& high = kept.level->high;
        high.set_candidates(bricks);
        kept.level->bricks = std::move(bricks);
        hold(divided, context, query);
        update(kept, changed, threshold, context, query);
        return changes;
    }

    void add_extremes(LevelBricks& bricks, const Context& context) const override {
        add_extremes(BrickPart(grid_), context.threads, bricks);
    }

    [[nodiscard]] const BrickGrid& grid() const override { return grid_; }

    [[nodiscard]] StoredWindow classify_window(double tau, const Box& bricks, const BrickFlags& kept, const Context& context,
                                               LevelQuery& query) override {
        LevelQuery own;  // copied samples need no lease; destroyed after the lock
        const std::lock_guard lock(mutex_);
        const Threshold<T> threshold = threshold_for<T>(tau);
        const BrickPart part(grid_, bricks);
        Classified classified = classify_part(part, bricks_of(part, threshold, context.threads, kept), threshold, context, own);
        StoredWindow result{info_, {info_.extent, part.origin}, {}, std::move(classified.level)};
        result.info.extent = part.grid.extent;
        add_extremes(part, 1, result.level.bricks);
        result.samples.resize(static_cast<std::size_t>(part.grid.extent.voxels()) * sizeof(T));
        for (const BrickId b : classified.needed) copy_brick(b, part, reinterpret_cast<T*>(result.samples.data()));
        query += own;
        query.visited += own.visited;
        return result;
    }

    [[nodiscard]] Foreseen foresee(double tau) const override {
        const LevelBricks bricks = bricks_of(BrickPart(grid_), threshold_for<T>(tau), 1);
        const std::vector<BrickId> beside = flagged(touching_others(grid_, bricks.classes));
        const IoCounters min = bricks_.cost_of(divided_bricks(BrickPart(grid_), bricks));
        Foreseen foreseen{min, min};
        foreseen.max += bricks_.max_of_part(beside);
        return foreseen;
    }

    [[nodiscard]] std::array<double, 2> range() const override {
        T low = bricks_.low(BrickId(0)), high = bricks_.high(BrickId(0));
        for (const BrickId b : grid_.bricks()) low = std::min(low, bricks_.low(b)), high = std::max(high, bricks_.high(b));
        return {static_cast<double>(low), static_cast<double>(high)};
    }

    [[nodiscard]] std::array<double, 2> range(BrickId brick) const override {
        return {static_cast<double>(bricks_.low(brick)), static_cast<double>(bricks_.high(brick))};
    }

    [[nodiscard]] double sample(std::int64_t voxel, IoCounters& counters) override {
        LevelQuery query;  // destroyed after the lock
        const std::lock_guard lock(mutex_);
        const Index3 at = info_.extent.voxel(voxel);
        Context alone;
        alone.threads = 1;
        load({grid_.brick(BrickGrid::place_of(at))}, alone, query);
        counters += query;
        return static_cast<double>(samples()[layout_.by_voxel().at(at[0], at[1], at[2])]);
    }

    void read_all(std::span<std::byte> out, const Context& context, IoCounters& counters) override {
        counters += bricks_.read_all(std::span<T>(reinterpret_cast<T*>(out.data()), out.size() / sizeof(T)), context);
    }

    void read_some(IdSpan<BrickId, const std::uint8_t> bricks, std::span<std::byte> out, const Context& context,
                   IoCounters& counters) override {
        T* whole = reinterpret_cast<T*>(out.data());
        for_bricks(grid_, context.threads, [&](BrickId b) {
            if (bricks[b] == 0) fill_with(bricks_.low(b), grid_.box(b), whole);
        });
        counters += bricks_.read_into(whole, flagged(bricks), context);
    }

    void read_box(const Box& box, std::int64_t step, std::span<std::byte> out, const Context& context, IoCounters& counters) override {
        read_samples(bricks_, box, step, context, std::span<T>(reinterpret_cast<T*>(out.data()), out.size() / sizeof(T)), counters);
    }

    void read_means(std::int64_t step, std::int64_t layer, std::span<float> out, const Context& context, IoCounters& counters) override {
        isoatlas::read_means(bricks_, step, layer, context, out, counters);
    }

    std::vector<std::int64_t> histogram(std::span<const double> edges, const Context& context, IoCounters& counters) override {
        return brick_histogram(bricks_, edges, context, counters);
    }

    void check(const Context& context) const override { bricks_.check(context); }

    void clear() override {
        const std::lock_guard lock(mutex_);
        cache_.clear();
    }

    [[nodiscard]] std::int64_t present_bytes() const override {
        const std::lock_guard lock(mutex_);
        return cache_.bytes();
    }

private:
    [[nodiscard]] T* samples() { return reinterpret_cast<T*>(array_.data()); }

    /// Decodes the samples of a brick into its slot.
    void place(BrickId brick, std::span<const T> values) {
        if (static_cast<std::int64_t>(values.size()) == layout_.samples_of_brick()) {
            std::copy(values.begin(), values.end(), samples() + layout_.first_sample(brick));
            return;
        }
        const Index3 size = grid_.box(brick).size();
        const T* from = values.data();
        for (std::int64_t z = 0; z < size[2]; ++z) {
            for (std::int64_t y = 0; y < size[1]; ++y, from += size[0]) std::copy_n(from, size[0], samples() + layout_.row(brick, y, z));
        }
    }

    /// For bricks in ascending order; adjacent ones are merged into one call.
    void take_memory(const std::vector<BrickId>& bricks, int threads) {
        constexpr std::int64_t kTogether = 32;
        const auto count = static_cast<std::int64_t>(bricks.size());
        for_each_block(threads, (count + kTogether - 1) / kTogether, [&](std::int64_t block) {
            const std::int64_t end = std::min((block + 1) * kTogether, count);
            for (std::int64_t i = block * kTogether; i < end;) {
                std::int64_t next = i + 1;
                while (next < end && bricks[next] == bricks[next - 1].next()) ++next;
                array_.commit(static_cast<std::size_t>(layout_.first_sample(bricks[i])) * sizeof(T),
                              static_cast<std::size_t>(layout_.samples_of_brick() * (next - i)) * sizeof(T));
                i = next;
            }
        });
    }

    /// Loads bricks and leases them to the query.
    void load(const std::vector<BrickId>& wanted, const Context& context, LevelQuery& query) {
        const std::vector<BrickId> missing = cache_.admit(wanted, query.held);
        try {
            take_memory(missing, context.threads);
            ReadProgress progress(context, missing.size());
            query += bricks_.read(missing, context, [&](BrickId brick, auto values) { place(brick, values), progress.add(); });
        } catch (...) {
            cache_.abandon(missing);
            throw;
        }
        cache_.settle(missing);
    }
    /// The same, and counts them as read by the query.
    void hold(const std::vector<BrickId>& wanted, const Context& context, LevelQuery& query) {
        load(wanted, context, query);
        for (const BrickId b : wanted) query.visited += grid_.box(b).count();
    }

    [[nodiscard]] BrickClass class_of(BrickId brick, const Threshold<T>& threshold) const {
        if (threshold.none_high || bricks_.high(brick) < threshold.min) return BrickClass::low;
        return bricks_.low(brick) >= threshold.min ? BrickClass::high : BrickClass::divided;
    }

    struct Classified {
        StoredLevel level;
        IdArray<BrickId, BrickFaces> sides;  ///< of the divided bricks
        std::vector<BrickId> needed;         ///< bricks whose samples a surface with normals needs; they are present
    };

    /// Each round reads a sixth of what was read before, so that there are few rounds however long the region is. Returns whether it is
    /// complete: not, when it takes more than `most` bricks.
    bool read_region(RegionGrowing& region, std::int64_t most, T min, const Context& context, LevelQuery& query) {
        constexpr std::int64_t kReadTogether = 32;  // bricks
        std::int64_t read = 0;
        for (std::vector<BrickId> missing = region.grow(); !missing.empty(); missing = region.grow()) {
            region.extend(missing, std::max(kReadTogether, read / 6));
            read += std::ssize(missing);
            if (read > most) return false;
            load(missing, context, query);
            for (const BrickId b : missing) region.add(b, bits_of_brick(samples() + layout_.first_sample(b), grid_.box(b).size(), min));
        }
        return true;
    }

    /// around: the bricks of the part. What it calls Low counts as Low.
    Classified classify_part(const BrickPart& part, LevelBricks around, const Threshold<T>& threshold, const Context& context,
                             LevelQuery& query) {
        HighBits bits(around);
        Classified result{
            {std::move(bits), std::move(around)}, IdArray<BrickId, BrickFaces>(static_cast<std::size_t>(part.grid.count())), {}};
        auto& [high, bricks] = result.level;
        result.needed = divided_bricks(part, bricks);
        hold(result.needed, context, query);
        fill(high, part, bricks.classes, threshold.min, context.threads, result.sides);
        std::vector<BrickId> beside = beside_surface(high, bricks, result.sides, context.threads);
        for (BrickId& b : beside) b = part.number(b);
        hold(beside, context, query);
        result.needed.insert(result.needed.end(), beside.begin(), beside.end());
        return result;
    }

    std::int64_t classify_anew(KeptLevel& kept, LevelBricks bricks, const Threshold<T>& threshold, const Context& context,
                               LevelQuery& query) {
        kept.level.reset();  // its memory is used again
        Classified all = classify_part(BrickPart(grid_), std::move(bricks), threshold, context, query);
        kept.beside = BrickFlags(all.level.bricks.classes.size(), 0);
        for (const BrickId b : all.needed) kept.beside[b] = all.level.bricks.classes[b] != BrickClass::divided;
        kept.level = std::move(all.level);
        kept.sides = std::move(all.sides);
        return grid_.count();
    }

    /// The samples of the divided bricks are present.
    void update(KeptLevel& kept, const BrickFlags& changed, const Threshold<T>& threshold, const Context& context, LevelQuery& query) {
        const auto& [high, bricks] = *kept.level;
        refill(changed, bricks.classes, threshold.min, context.threads, kept);
        const BrickFlags near = with_halo(grid_, changed);
        const BrickFlags touching = touching_others(grid_, bricks.classes);
        for_bricks(grid_, context.threads, [&](BrickId b) {
            if (near[b]) kept.beside[b] = touching[b] && touches_surface(high, bricks, kept.sides, b);
        });
        hold(flagged(kept.beside), context, query);
    }

    /// Bricks with a sample whose class differs between two isovalues.
    [[nodiscard]] BrickFlags bricks_between(Threshold<T> low, Threshold<T> high) const {
        if (low.none_high || (!high.none_high && high.min < low.min)) std::swap(low, high);
        BrickFlags between(static_cast<std::size_t>(grid_.count()), 0);
        if (low.none_high || (!high.none_high && low.min == high.min)) return between;
        for (const BrickId b : grid_.bricks()) between[b] = bricks_.high(b) >= low.min && (high.none_high || bricks_.low(b) < high.min);
        return between;
    }

    void refill(const BrickFlags& changed, IdSpan<BrickId, const BrickClass> classes, T min, int threads, KeptLevel& kept) {
        HighBits& high = kept.level->high;
        for_each_block(threads, grid_.size[1] * grid_.size[2], [&](std::int64_t row_of_bricks) {
            for (const BrickId b : grid_.bricks_of_row(row_of_bricks)) {
                if (!changed[b]) continue;
                const Box box = grid_.box(b);
                if (classes[b] == BrickClass::divided)
                    kept.sides[b] = fill_brick(high, box, b, min);
                else
                    put_brick(classes[b] == BrickClass::high ? whole_brick(box.size()) : BrickBits{}, box, high);
            }
        });
    }

    /// Classification by the ranges of the bricks alone. kept: of the whole grid; all other bricks count as Low. Empty: none does.
    [[nodiscard]] LevelBricks bricks_of(const BrickPart& part, const Threshold<T>& threshold, int threads,
                                        const BrickFlags& kept = {}) const {
        LevelBricks bricks{part.grid, IdArray<BrickId, BrickClass>(static_cast<std::size_t>(part.grid.count())), {}, {}};
        for_bricks(part.grid, threads, [&](BrickId b) { bricks.classes[b] = class_of(part.number(b), threshold); });
        if (!kept.empty()) make_others_low(part, kept, bricks.classes);
        return bricks;
    }
    void add_extremes(const BrickPart& part, int threads, LevelBricks& bricks) const {
        bricks.highest.items().resize(bricks.classes.size());
        bricks.lowest.items().resize(bricks.classes.size());
        for_bricks(part.grid, threads, [&](BrickId b) {
            const BrickId brick = part.number(b);
            if (bricks.classes[b] != BrickClass::low)
                bricks.highest[b] = {part.voxel(bricks_.highest_voxel(brick)), static_cast<double>(bricks_.high(brick))};
            if (bricks.classes[b] != BrickClass::high)
                bricks.lowest[b] = {part.voxel(bricks_.lowest_voxel(brick)), static_cast<double>(bricks_.low(brick))};
        });
    }

    void fill_with(T value, const Box& box, T* whole) const {
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y)
                std::fill_n(whole + grid_.extent.index(box.begin[0], y, z), box.size(0), value);
        }
    }

    void copy_brick(BrickId brick, const BrickPart& part, T* to) {
        const Box box = grid_.box(brick);
        const auto bytes = static_cast<std::size_t>(box.size(0)) * sizeof(T);
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
                const std::int64_t at = part.grid.extent.index(box.begin[0] - part.origin[0], y - part.origin[1], z - part.origin[2]);
                std::memcpy(to + at, samples() + layout_.row(brick, y - box.begin[1], z - box.begin[2]), bytes);
            }
        }
    }

    void fill(HighBits& high, const BrickPart& part, IdSpan<BrickId, const BrickClass> classes, T min, int threads,
              IdSpan<BrickId, BrickFaces> sides) {
        const BrickGrid& grid = part.grid;
        for_each_block(threads, grid.size[1] * grid.size[2], [&](std::int64_t row_of_bricks) {
            const auto brick = [&](std::int64_t i) { return BrickId(row_of_bricks * grid.size[0] + i); };
            const Box box = grid.box(brick(0));
            std::vector<std::uint64_t> whole(static_cast<std::size_t>(high.words() + 1));
            for (std::int64_t i = 0; i < grid.size[0]; ++i) {
                const std::uint64_t ones = 0xffff >> (kBrickRow - grid.length(0, i));
                if (classes[brick(i)] == BrickClass::high) put_bits(whole.data(), i * kBrickRow + 1, ones);
            }
            for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
                for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) std::copy(whole.begin(), whole.end(), high.row(y, z));
            }
            for (std::int64_t i = 0; i < grid.size[0]; ++i) {
                const BrickId b = brick(i);
                if (classes[b] != BrickClass::divided) continue;
                if (i + 1 < grid.size[0] && classes[b.next()] == BrickClass::divided) prefetch_brick(part.number(b.next()));
                sides[b] = fill_brick(high, grid.box(b), part.number(b), min);
            }
        });
    }

    void prefetch_brick(BrickId brick) {
        const T* const place = samples() + layout_.first_sample(brick);
        prefetch(place, place + layout_.samples_of_brick());
    }
    /// box: of the brick in the part that `high` belongs to.
    BrickFaces fill_brick(HighBits& high, const Box& box, BrickId brick, T min) {
        const BrickBits bits = bits_of_brick(samples() + layout_.first_sample(brick), box.size(), min);
        put_brick(bits, box, high);
        return sides_of(bits, box.size());
    }

    VolumeInfo info_;
    BrickReader<T> bricks_;
    const BrickGrid& grid_;
    BrickLayout layout_;
    VirtualArray array_;
    mutable std::mutex mutex_;
    BrickCache cache_;
};

}  // namespace

std::unique_ptr<StoredSamples> stored_samples(const Container& store, std::int64_t cache_bytes) {
    return visit_type(store.contents().volume.type,
                      [&]<class T>(T) -> std::unique_ptr<StoredSamples> { return std::make_unique<Samples<T>>(store, cache_bytes); });
}

}  // namespace isoatlas
