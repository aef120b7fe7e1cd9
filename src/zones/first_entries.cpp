// The head of a table of objects, and the notes that its entries have there.
#include "isoatlas/objects.h"

namespace isoatlas {

// What contains an entry lies in each other: when the closest one is gone, the one around it is the closest.
ObjectTable first_entries(ObjectTable table, std::int64_t top) {
    std::vector<ObjectEntry>& entries = table.entries;
    const auto all = static_cast<std::int64_t>(entries.size()), count = top > 0 && top < all ? top : all;
    for (std::int64_t i = 0; i < count; ++i) {
        ObjectEntry& entry = entries[static_cast<std::size_t>(i)];
        while (entry.inside >= count) entry.inside = entries[static_cast<std::size_t>(entry.inside)].inside;
        entry.note = entry.outline       ? "outline"
                     : entry.inside >= 0 ? "inside " + std::to_string(entry.inside + 1)
                     : entry.trunk       ? "largest"
                                         : "";
    }
    entries.resize(static_cast<std::size_t>(count));
    return table;
}

}  // namespace isoatlas
