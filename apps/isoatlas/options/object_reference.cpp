#include "options/object_reference.h"

#include <cmath>

#include <isoatlas/isoatlas.h>

#include "options/words.h"

namespace isoatlas::cli {
namespace {

[[noreturn]] void bad_reference(const std::string& option, const std::string& word) {
    throw Error(
        ErrorKind::usage,
        {.what = option + " cannot be \"" + word + "\"",
         .expected = "the number of an object in the table, c and that of a cavity, v and the number of a voxel, or a name; each may "
                     "have an isovalue behind it: 2, c3, v81275, skull, 2@150",
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
    const std::string_view digits = std::string_view(reference.word).substr(reference.word.empty() ? 0 : 1);
    if (reference.word.starts_with('+')) bad_reference(option, word);
    if (read_number(reference.word, reference.number)) {
        reference.kind = number;
    } else if (reference.word.starts_with('c') && read_number(digits, reference.number)) {
        reference.kind = cavity;
    } else if (reference.word.starts_with('v') && read_number(digits, reference.number)) {
        reference.kind = voxel;
    } else {
        reference.kind = name;
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

}  // namespace isoatlas::cli
