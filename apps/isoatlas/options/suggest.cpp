#include "options/suggest.h"

#include <algorithm>

#include "isoatlas/text.h"

namespace isoatlas::cli {
namespace {

/// The same letters, two of them exchanged, say: "lsp" of "lps".
bool has_same_letters(std::string a, std::string b) {
    std::ranges::sort(a);
    std::ranges::sort(b);
    return a == b;
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    // "obj" is the beginning of objects; what shares one letter with a short word is no typing error of it.
    const std::string_view letters = std::string_view(word).substr(std::min(word.size(), word.find_first_not_of('-')));
    std::string best;
    for (const std::string& candidate : known) {
        if (letters.size() >= 3 && candidate.starts_with(word)) return candidate;
    }
    std::size_t min = std::max<std::size_t>(2, letters.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(word, candidate);
        const bool is_other_word = letters.size() <= 3 && distance > 1 && !has_same_letters(word, candidate);
        if (distance < min && !is_other_word) {
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
