#include "critical/basins.h"

#include <array>
#include <bit>

#include "base/streamed.h"

namespace isoatlas {
namespace {

// Neighbours in the order of preference: before along x, y, z (basin known), then behind.
constexpr std::array<int, 6> kPreference{0, 2, 4, 1, 3, 5};

/// For every set of neighbours (bits as in a link) the preferred one, 6 for the empty set.
constexpr std::array<std::uint8_t, 64> kChoice = [] {
    std::array<std::uint8_t, 64> choice{};
    for (int set = 0; set < 64; ++set) {
        choice[set] = 6;
        for (int i = 5; i >= 0; --i) {
            if (set >> kPreference[i] & 1) choice[set] = static_cast<std::uint8_t>(kPreference[i]);
        }
    }
    return choice;
}();

}  // namespace

template <class Number>
Basins<Number>::Basins(const Extent& extent, std::int64_t slab_height, Direction direction, std::span<const std::uint8_t> links,
                       std::span<Number> basin)
    : extent_(extent), height_(slab_height), direction_(direction), links_(links), basin_(basin) {
    ISOATLAS_CHECK(static_cast<std::uint64_t>(extent.voxels()) < std::uint64_t{kNumber});
}

template <class Number>
void Basins<Number>::forward(std::int64_t slab, std::int64_t first_number) {
    const Slab range = this->range(slab);
    Number next = static_cast<Number>(first_number) + (direction_ == Direction::down ? Number{1} : Number{0});
    point(range, next);
    // Backwards: pointers to later voxels of the slab find them resolved as far as the slab goes.
    const std::int64_t first = range.z_begin * extent_.slice(), last = range.z_end * extent_.slice();
    const auto begin = static_cast<Number>(first), count = static_cast<Number>(last - first);
    const auto stays = [&](Number entry) { return static_cast<Number>(entry - begin) >= count; };  // numbers are beyond all voxels
    std::vector<std::int64_t> path;
    for (std::int64_t v = last - 1; v >= first; --v) {
        const Number entry = basin_[v];
        if (stays(entry)) continue;
        const Number further = basin_[entry];
        if (stays(further)) {  // nearly always
            basin_[v] = further;
        } else {
            compress(v, first, last, path);
        }
    }
}

template <class Number>
void Basins<Number>::point(Slab slab, Number& next) {
    const std::int64_t nx = extent_.size[0], ny = extent_.size[1], nz = extent_.size[2], slice = extent_.slice();
    const std::array<std::int64_t, 6> step{-1, 1, -nx, nx, -slice, slice};
    const bool down = direction_ == Direction::down, is_3d = extent_.rank == 3;
    const std::uint8_t flip = down ? (is_3d ? 0b111111 : 0b001111) : 0;
    for (const Block slice_block : streamed_blocks(slab.z_end - slab.z_begin, 1)) {
        const std::int64_t z = slab.z_begin + static_cast<std::int64_t>(slice_block.first);
        const std::uint8_t known = z > slab.z_begin ? 0b010101 : 0b000101;  // neighbours with an entry in this slab
        for (std::int64_t y = 0; y < ny; ++y) {
            const std::int64_t row = nx * (y + ny * z);
            const bool border_row = down && (y == 0 || y == ny - 1 || (is_3d && (z == 0 || z == nz - 1)));
            for (std::int64_t x = 0; x < nx; ++x) {
                const std::int64_t v = row + x;
                if (border_row || (down && (x == 0 || x == nx - 1))) {
                    basin_[v] = kNumber;  // EXT
                    continue;
                }
                const int choice = kChoice[links_[v] ^ flip];
                if (choice == 6) {
                    basin_[v] = next++ | kNumber;
                } else {
                    const std::int64_t target = v + step[choice];
                    basin_[v] = known >> choice & 1 ? basin_[target] : static_cast<Number>(target);
                }
            }
        }
    }
}

template <class Number>
void Basins<Number>::compress(std::int64_t voxel, std::int64_t first, std::int64_t last, std::vector<std::int64_t>& path) {
    path.clear();
    Number entry = basin_[voxel];
    while (!(entry & kNumber)) {
        const auto target = static_cast<std::int64_t>(entry);
        if (target < first || target >= last) break;
        path.push_back(voxel);
        voxel = target;
        entry = basin_[voxel];
    }
    for (const std::int64_t v : path) basin_[v] = entry;
}

template <class Number>
void Basins<Number>::exits() {
    std::vector<std::int64_t> path;
    const std::int64_t slice = extent_.slice();
    for (const Block depth : streamed_blocks(extent_.size[2], height_)) {
        const Slab slab = slab_at(static_cast<std::int64_t>(depth.first) / height_, height_, extent_.size[2]);
        for (const std::int64_t z : {slab.z_begin, slab.z_end - 1}) {
            for (std::int64_t v = z * slice; v < (z + 1) * slice; ++v) compress(v, 0, extent_.voxels(), path);
        }
    }
}

template <class Number>
void Basins<Number>::finish(std::int64_t slab) {
    // What is not resolved by now points to a border slice of another slab, which exits() resolved: no thread writes there any more.
    const Slab range = this->range(slab);
    const std::int64_t first = range.z_begin * extent_.slice(), last = range.z_end * extent_.slice();
    for (std::int64_t v = first; v < last; ++v) {
        const Number entry = basin_[v];
        if (!(entry & kNumber)) basin_[v] = basin_[static_cast<std::int64_t>(entry)];
    }
}

template class Basins<std::uint32_t>;
template class Basins<std::uint64_t>;

}  // namespace isoatlas
