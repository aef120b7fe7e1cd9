// What searches look at beyond the active cells, against what their sources promise: volumes of growing size, smooth and noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "isoatlas/phantom.h"
#include "unit/methods/searches.h"

namespace oracle {
namespace {

using isoatlas::CellSearchCost;

struct Cost {
    double n, k, beyond;  ///< cells of the volume; active ones; nodes and cells looked at beyond them
};

/// Of all searches, at isovalues between the samples of the volume.
std::map<std::string, std::vector<Cost>> costs_of(const char* phantom, std::int64_t size) {
    const isoatlas::Volume volume = isoatlas::make_phantom(phantom, {.size = size});
    double low = volume.value(0), high = low;
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i)
        low = std::min(low, volume.value(i)), high = std::max(high, volume.value(i));
    Searches searches(volume);
    std::map<std::string, std::vector<Cost>> costs;
    const auto n = static_cast<double>((size - 1) * (size - 1) * (size - 1));
    for (int i = 1; i < 12; ++i) {
        for (const auto& [name, search] : searches.all()) {
            CellSearchCost cost;
            (void)search->active(low + (high - low) * i / 12, cost);
            costs[name].push_back({n, static_cast<double>(cost.active), static_cast<double>(cost.cells + cost.nodes - cost.active)});
        }
    }
    return costs;
}

double most(const std::vector<Cost>& costs) { return std::ranges::max(costs, {}, &Cost::beyond).beyond; }

TEST(Complexity, IsThatOfTheSources) {
    for (const char* phantom : {"random-field", "noise"}) {
        std::map<std::string, double> before;
        for (const std::int64_t size : {16, 32, 64}) {
            for (const auto& [name, costs] : costs_of(phantom, size)) {
                SCOPED_TRACE(std::string(phantom) + " " + std::to_string(size) + " " + name);
                const double n = costs.front().n, beyond = most(costs);
                if (name == "brute-force") {
                    for (const Cost& cost : costs) EXPECT_EQ(cost.k + cost.beyond, n);
                }
                // A path, each node of it with at most one cell too many; 2 n ends at most make the tree.
                if (name == "interval-tree") {
                    EXPECT_LE(beyond, 2 * (std::log2(2 * n) + 1));
                }
                if (name == "span-space-tree") {
                    EXPECT_LE(beyond, 12 * std::sqrt(n));
                }
                // Of nodes that the isovalue divides, each with an active cell, on every level: k log n.
                if (name == "bono" || name == "octree") {
                    for (const Cost& cost : costs) EXPECT_LE(cost.beyond, (8 + std::log2(n) / 3 + 1) * cost.k);
                }
                // The sizes are 8 times the one before: exponents are logarithms to that base.
                if (before.contains(name)) {
                    const double exponent = std::log(beyond / before[name]) / std::log(8.0);
                    if (name == "interval-tree") {
                        EXPECT_LT(exponent, 0.25);
                    }
                    if (name == "span-space-tree") {
                        EXPECT_GT(exponent, 0.4);
                        EXPECT_LT(exponent, 0.65);
                    }
                    if (name == "brute-force" || name == "sweeping-simplices") {
                        EXPECT_GT(exponent, 0.8);
                    }
                }
                before[name] = beyond;
            }
        }
    }
}

}  // namespace
}  // namespace oracle
