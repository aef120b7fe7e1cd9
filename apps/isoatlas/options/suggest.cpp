#include "options/suggest.h"

#include <algorithm>

#include "isoatlas/text.h"

namespace isoatlas::cli {

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    // "obj" is the beginning of objects; what shares one letter with a short word is no typing error of it.
    const std::string_view letters = std::string_view(word).substr(std::min(word.size(), word.find_first_not_of('-')));
    std::string best;
    for (const std::string& candidate : known) {
        if (letters.size() >= 3 && candidate.starts_with(word)) return candidate;
    }
    std::size_t min = std::max<std::size_t>(letters.size() > 3 ? 2 : 1, letters.size() / 3) + 1;
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
