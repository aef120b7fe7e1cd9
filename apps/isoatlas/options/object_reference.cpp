#include "options/object_reference.h"

#include <cmath>

#include <isoatlas/isoatlas.h>

#include "options/words.h"

namespace isoatlas::cli {
namespace {

constexpr std::string_view kLow = "low";

/// "low2", "lowc3", "lowv81275"; "lowlands" is a name.
bool is_of_low_values(std::string_view word) {
    if (!word.starts_with(kLow)) return false;
    word.remove_prefix(kLow.size());
    if (word.starts_with('c') || word.starts_with('v')) word.remove_prefix(1);
    return word.starts_with('-') || word.starts_with('+') || (!word.empty() && word[0] >= '0' && word[0] <= '9');
}

[[noreturn]] void bad_reference(const std::string& option, const std::string& word) {
    throw Error(
        ErrorKind::usage,
        {.what = option + " cannot be \"" + word + "\"",
         .expected = "the number of an object in the table, c and that of a cavity, v and the number of a voxel, or a name; low before "
                     "one of low values; each may have an isovalue behind it: 2, c3, v81275, low2, skull, 2@150",
         .next = "isoatlas objects lists the numbers"});
}

}  // namespace

ObjectReference parse_reference(const std::string& option, const std::string& word) {
    const std::size_t at = word.find('@');
    ObjectReference reference{.tau = {}, .word = word.substr(0, at)};
    if (at != std::string::npos) {
        double tau = 0;
        if (!read_number(std::string_view(word).substr(at + 1), tau) || !std::isfinite(tau)) bad_reference(option, word);
        reference.tau = tau;
    }
    using enum ObjectReference::Kind;
    const bool is_low = is_of_low_values(reference.word);
    const std::string_view own = std::string_view(reference.word).substr(is_low ? kLow.size() : 0);
    const std::string_view digits = own.substr(own.empty() ? 0 : 1);
    if (is_low) reference.polarity = Polarity::low;
    if (own.starts_with('+')) bad_reference(option, word);
    if (read_number(own, reference.number)) {
        reference.kind = number;
    } else if (own.starts_with('c') && read_number(digits, reference.number)) {
        reference.kind = cavity;
    } else if (own.starts_with('v') && read_number(digits, reference.number)) {
        reference.kind = voxel;
    } else {
        reference.kind = name, reference.polarity.reset();
        try {
            check_object_name(reference.word);
        } catch (const Error&) {
            bad_reference(option, word);
        }
        return reference;
    }
    if (reference.number < 0) bad_reference(option, word);
    return reference;
}

std::vector<ObjectReference> parse_references(const std::string& option, const std::vector<std::string>& words) {
    std::vector<ObjectReference> references;
    for (const std::string& word : words) {
        for (std::size_t begin = 0; begin <= word.size();) {
            const std::size_t end = std::min(word.find(',', begin), word.size());
            references.push_back(parse_reference(option, word.substr(begin, end - begin)));
            begin = end + 1;
        }
    }
    return references;
}

std::string voxel_word(std::int64_t voxel) { return "v" + std::to_string(voxel); }
std::string cavity_word(std::int64_t number) { return "c" + std::to_string(number); }
std::string with_polarity(const std::string& word, Polarity polarity) {
    return polarity == Polarity::low ? std::string(kLow) + word : word;
}

}  // namespace isoatlas::cli
