// Values of the ambiguous faces around a row of cells, computed together: every face takes part in two cells and in the critical elements.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

#include "critical/faces.h"
#include "field/order.h"

namespace isoatlas {

/// The face bytes of a slice; and, per voxel and orientation (2 bits), in how many cells the face has type H.
struct SliceFaces {
    static constexpr std::size_t kBehind = 31;  // bytes that may be read behind the last

    std::vector<std::uint8_t> faces, high;
    bool any = false;

    explicit SliceFaces(std::int64_t voxels) : faces(voxels + kBehind), high(voxels) {}
};

template <class T>
class FaceRows {
public:
    explicit FaceRows(const GridView<T>& grid) : grid_(grid) {
        const GridSteps steps(grid.extent);
        for (int o = 0; o < 3; ++o) {
            for (int corner = 0; corner < 4; ++corner) step_[o][corner] = steps.face_corner(o, corner);
        }
        for (std::vector<double>* row : {&mine_, &behind_, &above_}) row->resize(3 * grid.extent.size[0]);
    }

    /// Finds the values of row y in slice z; rows of a slice come in order. with_cells: and those that the cells between z and z + 1 need.
    /// Cost: O(row + ambiguous faces).
    void find(std::int64_t y, std::int64_t z, const SliceFaces& lower, const SliceFaces& upper, bool with_cells) {
        const std::int64_t n = grid_.extent.size[0], row = y * n;
        const bool is_begun = with_cells && y > 0;
        if (is_begun) mine_.swap(behind_);
        find(mine_, grid_.row(y, z), lower.faces.data() + row, kFaceBits[0] | kFaceBits[2] | (is_begun ? 0U : kFaceBits[1]));
        if (with_cells && y + 1 < grid_.extent.size[1]) {
            find(behind_, grid_.row(y + 1, z), lower.faces.data() + row + n, kFaceBits[1]);
            find(above_, grid_.row(y, z + 1), upper.faces.data() + row, kFaceBits[0]);
        }
        store();
    }

    /// Of voxel x of the row, and an orientation. Where no face is ambiguous it means nothing.
    [[nodiscard]] double mine(std::int64_t x, int orientation) const { return mine_[3 * x + orientation]; }
    /// Of the six faces of cell x of the row.
    [[nodiscard]] std::array<double, 6> of_cell(std::int64_t x) const {
        const double* mine = mine_.data() + 3 * x;
        return {mine[0], above_[3 * x], mine[1], behind_[3 * x + 1], mine[2], mine[5]};
    }

private:
    void find(std::vector<double>& value, const T* corner, const std::uint8_t* faces, unsigned orientations) {
        constexpr std::int64_t kTogether = SliceFaces::kBehind + 1;  // most have no ambiguous face
        const std::int64_t n = grid_.extent.size[0];
        for (std::int64_t first = 0; first < n; first += kTogether) {
            std::array<std::uint64_t, kTogether / 8> block;
            std::memcpy(block.data(), faces + first, sizeof block);
            if ((block[0] | block[1] | block[2] | block[3]) == 0) continue;
            for (std::int64_t x = first; x < std::min(n, first + kTogether); x += 8) {
                std::uint64_t some = block[(x - first) / 8] & 0x0101010101010101 * orientations;
                if (n - x < 8) some &= (std::uint64_t{1} << (8 * (n - x))) - 1;
                for (; some != 0; some &= some - 1) {
                    const int bit = std::countr_zero(some);
                    const std::int64_t voxel = x + bit / 8;
                    add(corner + voxel, bit % 8, &value[3 * voxel + bit % 8 / 2]);
                }
            }
        }
    }
    void add(const T* corner, int bit, double* value) {
        const std::array<std::int64_t, 4>& step = step_[bit / 2];
        const int bd_high = bit % 2;
        const auto at = [&](int i) { return static_cast<double>(corner[step[i]]); };
        place_[batch_.count()] = value;
        batch_.add(at(1 - bd_high), at(3 - bd_high), at(bd_high), at(bd_high + 2));
        if (batch_.count() == FaceBatch::kMax) store();
    }
    void store() {
        rounded_face_values(batch_, found_);
        for (std::size_t i = 0; i < batch_.count(); ++i) *place_[i] = found_[i];
        batch_.clear();
    }

    const GridView<T>& grid_;
    std::array<std::array<std::int64_t, 4>, 3> step_{};
    std::vector<double> mine_, behind_, above_;  // of the row; of y + 1, the xz faces; of z + 1, the xy faces. Orientation o of x: 3 x + o
    FaceBatch batch_;
    std::array<double*, FaceBatch::kMax> place_{};
    std::array<double, FaceBatch::kMax> found_{};
};

}  // namespace isoatlas
