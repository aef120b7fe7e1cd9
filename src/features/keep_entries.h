// Removing entries from a table of objects.
#pragma once

#include <cstdint>
#include <vector>

namespace isoatlas {

/// keep: per entry. Entries that contain an entry are nested: when the closest one is removed, the next one around it is the closest.
template <class Entry>
void keep_entries(std::vector<Entry>& entries, const std::vector<bool>& keep) {
    std::vector<std::int64_t> place(entries.size(), -1);
    std::vector<Entry> kept;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (!keep[i]) continue;
        place[i] = static_cast<std::int64_t>(kept.size());
        kept.push_back(entries[i]);
    }
    for (Entry& entry : kept) {
        while (entry.inside >= 0 && !keep[static_cast<std::size_t>(entry.inside)])
            entry.inside = entries[static_cast<std::size_t>(entry.inside)].inside;
        if (entry.inside >= 0) entry.inside = place[static_cast<std::size_t>(entry.inside)];
    }
    entries = std::move(kept);
}

}  // namespace isoatlas
