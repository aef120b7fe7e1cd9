// pair_cavities: the elder rule on the split tree.
#include <algorithm>
#include <tuple>

#include "analysis/analysis_data.h"
#include "isoatlas/persistence.h"
#include "tree/split_tree.h"

namespace isoatlas {

std::vector<CavityPair> pair_cavities(const Analysis& analysis) {
    return analysis.data().visit([](const auto& held) {
        const auto& value = held.arrays.value;
        const auto low = split_tree_of(held.arrays.contours);
        std::vector<CavityPair> pairs;
        for (const auto x : value.ids()) {
            const auto above = low.parent[x], minimum = low.lowest[x];
            if (above == x || low.lowest[above] == minimum || value[above] == value[minimum]) continue;
            pairs.push_back({value[above], value[minimum], ElementId(above), ElementId(minimum)});
        }
        std::ranges::sort(pairs, {}, [](const CavityPair& pair) { return std::tuple(pair.closes, pair.fills); });
        return pairs;
    });
}

}  // namespace isoatlas
