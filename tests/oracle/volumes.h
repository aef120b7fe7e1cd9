// Random small volumes for RapidCheck: 1..7 samples an axis, of the kinds that hurt. Shrinking makes the volume smaller and its values
// simpler.
//
// Number of trials per property: ISOATLAS_TRIALS in the environment, else a default that keeps the suite short. RC_PARAMS wins over both
// (RC_PARAMS="seed=... max_success=..."; a failure prints the one that reproduces it).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <rapidcheck.h>

#include "isoatlas/analysis.h"
#include "oracle/oracle.h"

namespace oracle {

inline void use_trials_of_environment() {
    const char* trials = std::getenv("ISOATLAS_TRIALS");
    const std::string parameters = "max_success=" + std::string(trials ? trials : "100") + " max_size=100 verbose_progress=0";
    setenv("RC_PARAMS", parameters.c_str(), 0);
}
inline const bool kTrialsAreSet = (use_trials_of_environment(), true);

inline void showValue(const Grid& grid, std::ostream& out) {
    out << grid.rank << "D " << grid.size[0] << "x" << grid.size[1] << "x" << grid.size[2] << ":";
    out.precision(17);
    for (const double v : grid.value) out << " " << v;
}
inline std::ostream& operator<<(std::ostream& out, const Grid& grid) {
    showValue(grid, out);
    return out;
}

enum class Texture { uniform, ties2, ties3, ties4, ties8, smooth, smooth_quantised, checkerboard, checkerboard_ties, plateaus, constant };
inline constexpr int kTextures = 11;

/// The sample at voxel v of a texture from raw numbers 0..9999 (one per voxel).
inline double texture_value(Texture texture, const Grid& grid, Index v, const std::vector<int>& raw) {
    const std::array<Index, 3> p = grid.voxel(v);
    const int r = raw[static_cast<std::size_t>(v)];
    const auto wave = [&] {  // a few slow cosines; coefficients from the first raw numbers
        double sum = 0;
        for (int k = 0; k < 4; ++k) {
            const auto at = [&](int i) { return static_cast<double>(raw[static_cast<std::size_t>(7 * k + i) % raw.size()]) / 10000; };
            sum += at(0) * std::cos(3 * (at(1) - 0.5) * static_cast<double>(p[0]) + 3 * (at(2) - 0.5) * static_cast<double>(p[1]) +
                                    3 * (at(3) - 0.5) * static_cast<double>(p[2]) + 7 * at(4));
        }
        return sum;
    };
    const bool odd = (p[0] + p[1] + p[2]) % 2 != 0;
    switch (texture) {
        case Texture::uniform: return r / 64.0;
        case Texture::ties2: return r % 2;
        case Texture::ties3: return r % 3;
        case Texture::ties4: return r % 4;
        case Texture::ties8: return r % 8;
        case Texture::smooth: return wave();
        case Texture::smooth_quantised: return std::floor(4 * wave());
        case Texture::checkerboard: return (odd ? 100 : 0) + r / 500.0;
        case Texture::checkerboard_ties: return (odd ? 3 : 0) + r % 3;
        case Texture::plateaus: return r % 3 + r * 1e-9;
        case Texture::constant: return 5;
    }
    return 0;
}

inline Grid make_grid(int rank, std::array<Index, 3> size, Texture texture, const std::vector<int>& raw) {
    Grid grid{rank, size, {}};
    if (rank == 2) grid.size[2] = 1;
    for (Index v = 0; v < grid.voxels(); ++v) grid.value.push_back(texture_value(texture, grid, v, raw));
    return grid;
}

/// Sizes 1..longest per axis with at most `most` voxels; now and then one voxel thick.
inline rc::Gen<std::array<Index, 3>> arbitrary_size(Index longest, Index max) {
    return rc::gen::map(rc::gen::container<std::vector<int>>(4, rc::gen::inRange(0, 1000)), [longest, max](const std::vector<int>& raw) {
        std::array<Index, 3> size{};
        for (int a = 0; a < 3; ++a) size[a] = 1 + raw[a] % longest;
        if (raw[3] % 8 > 0 && raw[3] % 8 <= 3) size[raw[3] % 8 - 1] = 1;
        while (size[0] * size[1] * size[2] > max) --*std::max_element(size.begin(), size.end());
        return size;
    });
}

/// Any small volume; one in four is 2D.
inline rc::Gen<Grid> arbitrary_grid(Index longest = 7, Index max = 100) {
    return rc::gen::mapcat(arbitrary_size(longest, max), [](const std::array<Index, 3>& size) {
        const auto count = static_cast<std::size_t>(size[0] * size[1] * size[2]);
        return rc::gen::map(rc::gen::tuple(rc::gen::inRange(0, 4), rc::gen::inRange(0, kTextures),
                                           rc::gen::container<std::vector<int>>(count, rc::gen::resize(100, rc::gen::inRange(0, 10000)))),
                            [size](const std::tuple<int, int, std::vector<int>>& choice) {
                                const int rank = std::get<0>(choice) == 3 ? 2 : 3;
                                return make_grid(rank, size, static_cast<Texture>(std::get<1>(choice)), std::get<2>(choice));
                            });
    });
}

inline rc::Gen<isoatlas::Interpolant> arbitrary_interpolant() {
    return rc::gen::element(isoatlas::Interpolant::trilinear, isoatlas::Interpolant::faces);
}

/// Distinct values: the raw numbers made unique by their position.
inline Grid without_ties(Grid grid) {
    std::vector<std::pair<double, Index>> order;
    for (Index v = 0; v < grid.voxels(); ++v) order.push_back({grid.value[v], v * 7919 % 104729});  // not the engine's tie rule
    std::vector<Index> at(order.size());
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = static_cast<Index>(i);
    std::sort(at.begin(), at.end(), [&order](Index p, Index q) { return order[p] < order[q]; });
    for (std::size_t i = 0; i < at.size(); ++i) grid.value[at[i]] = static_cast<double>(i);
    return grid;
}

/// Whether two elements share a value.
inline bool has_ties(const Elements& elements) {
    for (Index r = 1; r < elements.count(); ++r) {
        if (elements.all[elements.by_rank[r]].value == elements.all[elements.by_rank[r - 1]].value) return true;
    }
    return false;
}

/// The distinct values of the elements, ascending, and values between and outside them.
inline std::vector<double> interesting_values(const Elements& elements) {
    std::vector<double> values;
    for (const Index e : elements.by_rank) {
        if (values.empty() || values.back() != elements.all[e].value) values.push_back(elements.all[e].value);
    }
    std::vector<double> all{values.front() - 1};
    for (std::size_t i = 0; i < values.size(); ++i) {
        all.push_back(values[i]);
        all.push_back(i + 1 < values.size() ? values[i] + (values[i + 1] - values[i]) / 2 : values[i] + 1);
    }
    return all;
}

/// Axis orders and mirror masks of a grid: 48 in 3D, 8 in 2D.
inline std::vector<std::pair<std::array<int, 3>, int>> turns(int rank) {
    std::vector<std::pair<std::array<int, 3>, int>> all;
    std::array<int, 3> order{0, 1, 2};
    do {
        if (rank == 2 && order[2] != 2) continue;
        for (int mirror = 0; mirror < 1 << rank; ++mirror) all.push_back({order, mirror});
    } while (std::next_permutation(order.begin(), order.end()));
    return all;
}

/// The volume seen along other axes: new axis a is old axis order[a], reversed when bit a of `mirror` is set.
inline Grid rotated(const Grid& grid, const std::array<int, 3>& order, int mirror) {
    Grid result{grid.rank, {grid.size[order[0]], grid.size[order[1]], grid.size[order[2]]}, {}};
    for (Index v = 0; v < grid.voxels(); ++v) {
        const std::array<Index, 3> p = result.voxel(v);
        std::array<Index, 3> q{};
        for (int a = 0; a < 3; ++a) q[order[a]] = (mirror >> a & 1) != 0 ? result.size[a] - 1 - p[a] : p[a];
        result.value.push_back(grid.value[grid.index(q[0], q[1], q[2])]);
    }
    return result;
}

/// Its images of the same size.
inline std::vector<Grid> images(const Grid& grid) {
    std::vector<Grid> all;
    for (const auto& [order, mirror] : turns(grid.rank)) {
        Grid image = rotated(grid, order, mirror);
        if (image.size == grid.size) all.push_back(std::move(image));
    }
    return all;
}

/// Calls visit(grid) for one of all turned images of this grid, another one in each run, and not at all where the grid is not the first of
/// them: of all grids, each kind is visited once. That turning changes nothing is a theorem of its own.
template <class Visit>
void for_one_image(const Grid& grid, std::mt19937_64& random, const Visit& visit) {
    const std::vector<Grid> all = images(grid);
    if (std::any_of(all.begin(), all.end(), [&](const Grid& image) { return image.value < grid.value; })) return;
    visit(all[random() % all.size()]);
}

}  // namespace oracle
