#include "options/suggest.h"

#include <algorithm>

#include "isoatlas/text.h"

namespace isoatlas::cli {

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    std::size_t min = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < min) {
            min = distance;
            best = candidate;
        }
    }
    return best;
}

std::string list_of(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace isoatlas::cli
