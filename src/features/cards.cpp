#include "isoatlas/cards.h"

#include <algorithm>
#include <unordered_map>

namespace isoatlas {
namespace {

/// One contains the other.
double overlap_of(const ObjectEntry& p, const ObjectEntry& q) {
    const auto [less, more] = std::minmax(p.voxels, q.voxels);
    return static_cast<double>(less) / static_cast<double>(more);
}

}  // namespace

std::vector<Card> cards_of(const ObjectTable& table, const Extent& extent) {
    std::vector<Card> cards;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> with_card;  // of each object
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const ObjectEntry& entry = table.entries[i];
        Card& card = cards.emplace_back(Card{.line = i, .is_background = is_background(table, i, extent)});
        if (!entry.branch_top.exists()) continue;  // which object it is is not known
        std::vector<std::size_t>& others = with_card[entry.branch_top.number()];
        double most = 0;
        for (const std::size_t other : others) {
            const double overlap = overlap_of(entry, table.entries[other]);
            if (cards[other].is_background != card.is_background || overlap < kSameShape || overlap <= most) continue;
            most = overlap;
            card.line = other, card.overlap = overlap;
        }
        if (card.line == i) others.push_back(i);
    }
    return cards;
}

}  // namespace isoatlas
