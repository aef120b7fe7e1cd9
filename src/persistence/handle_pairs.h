// From pairs of elements to handles.
// In the literature: persistence pairs of dimension 1 (Edelsbrunner, Letscher, Zomorodian, Topological persistence and simplification,
// 2002).
#pragma once

#include <algorithm>
#include <vector>

#include "analysis/analysis_data.h"
#include "field/order.h"
#include "isoatlas/handles.h"

namespace isoatlas {

struct HandlePair {
    ElementId opens, closes;
    bool is_open = false;  ///< Handle::is_open
};

template <class Id>
[[nodiscard]] std::vector<Handle> handles_of(const AnalysisArrays<Id>& arrays, const Extent& extent, std::vector<HandlePair> pairs,
                                             double min_persistence) {
    const auto persistence = [&](const HandlePair& pair) { return arrays.value[pair.opens] - arrays.value[pair.closes]; };
    std::erase_if(pairs, [&](const HandlePair& pair) { return !(persistence(pair) > 0 && persistence(pair) >= min_persistence); });
    std::ranges::sort(pairs, [&](const HandlePair& p, const HandlePair& q) {
        return persistence(p) != persistence(q) ? persistence(p) > persistence(q) : p.opens < q.opens;
    });
    std::vector<Handle> handles;
    for (const HandlePair& pair : pairs) {
        const auto [opens, closes, is_open] = pair;
        handles.push_back({arrays.value[opens], arrays.value[closes], element_position(ElementCode{arrays.code[opens]}, extent),
                           element_position(ElementCode{arrays.code[closes]}, extent), EventId(arrays.tree.event_of_element[opens]),
                           is_open});
    }
    return handles;
}

}  // namespace isoatlas
