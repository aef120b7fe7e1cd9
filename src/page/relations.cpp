#include "page/relations.h"

#include <cmath>
#include <unordered_map>

namespace isoatlas::page {

// Entries that lie on one path to the root meet at an event. Only one branch goes on below it: the one that merges still lower.
std::vector<std::int64_t> merge_targets(const ObjectTable& table, const Analysis& analysis) {
    std::vector<std::int64_t> target(table.entries.size(), -1);
    std::unordered_map<std::int64_t, std::vector<std::size_t>> ends_at;  // by event: entries that merge there
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const ObjectEntry& entry = table.entries[i];
        if (!std::isfinite(entry.merges)) continue;
        std::int64_t event = entry.event;
        while (event >= 0 && analysis.event(event).value > entry.merges) event = analysis.event(event).parent;
        if (event >= 0) ends_at[event].push_back(i);
    }
    for (std::size_t k = 0; k < table.entries.size(); ++k) {
        const ObjectEntry& other = table.entries[k];
        for (std::int64_t event = other.event; event >= 0; event = analysis.event(event).parent) {
            const auto found = ends_at.find(event);
            if (found == ends_at.end()) continue;
            for (const std::size_t i : found->second) {
                if (target[i] < 0 && other.merges < table.entries[i].merges) target[i] = static_cast<std::int64_t>(k);
            }
        }
    }
    return target;
}

}  // namespace isoatlas::page
