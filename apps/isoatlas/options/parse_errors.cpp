#include "options/parse_errors.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include <isoatlas/error.h>
#include <isoatlas/isoatlas.h>
#include <CLI/CLI.hpp>

#include "options/suggest.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Verbs of other programs, and what they are called here.
constexpr std::array<std::pair<std::string_view, const char*>, 14> kOtherWords{{{"list", "objects"},
                                                                                {"ls", "objects"},
                                                                                {"show", "view"},
                                                                                {"open", "view"},
                                                                                {"serve", "view"},
                                                                                {"mesh", "extract"},
                                                                                {"surface", "extract"},
                                                                                {"isosurface", "extract"},
                                                                                {"segment", "label"},
                                                                                {"picture", "render"},
                                                                                {"export", "extract"},
                                                                                {"stats", "measure"},
                                                                                {"page", "atlas"},
                                                                                {"check", "verify"}}};

/// The first option, or operand, that a message of CLI11 names; nullptr: none.
const CLI::Option* option_in(const CLI::App& app, const std::string& message) {
    const CLI::Option* first = nullptr;
    std::size_t at = std::string::npos;
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();  // --long, or the operand
        const std::size_t found = message.find(name);
        if (found == std::string::npos || found > at) continue;
        if (found == at && first->get_name().size() > name.size()) continue;  // --top, --top-most
        first = option, at = found;
    }
    return first;
}

template <class Kind>
bool is(const CLI::ParseError& error) {
    return dynamic_cast<const Kind*>(&error) != nullptr;
}

std::string value_of(const CLI::Option& option) { return option.get_type_name().empty() ? option.get_name() : option.get_type_name(); }

}  // namespace

void usage(const std::string& what, const std::string& next, const std::string& expected) {
    throw Error(ErrorKind::usage, {.what = what, .expected = expected, .next = next});
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

void explain(const CLI::App& app, const std::string& verb, const std::vector<std::string>& words, const CLI::ParseError& error) {
    const std::vector<std::string> known = option_names(app);
    const std::string help = "isoatlas " + verb + " --help";
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (word.rfind("--", 0) != 0 || word == "--" || std::count(known.begin(), known.end(), name) > 0) continue;
        const std::string near = nearest(name, known);
        usage("`isoatlas " + verb + "` has no option " + name,
              (near.empty() ? "" : "did you mean " + near + "? ") + ("all options: " + help));
    }
    const std::string message = error.what();
    if (is<CLI::ExtrasError>(error)) {
        const std::size_t behind = message.rfind(": ");
        usage("more than `isoatlas " + verb + "` takes: " + (behind == std::string::npos ? message : message.substr(behind + 2)),
              "quote names with blanks, or " + help);
    }
    const CLI::Option* option = option_in(app, message);
    if (option == nullptr) usage(message, help);
    const std::string name = option->get_name(), value = value_of(*option);
    if (is<CLI::RequiredError>(error))
        usage("`isoatlas " + verb + "` needs " + (option->get_positional() ? name : name + " " + value), help);
    if (is<CLI::ArgumentMismatch>(error)) usage(name + " has no value", help, name + " " + value);
    if (is<CLI::ConversionError>(error)) {
        const std::size_t behind = message.find(" = ");
        const std::string typed = behind == std::string::npos ? "this" : message.substr(behind + 3);
        usage(name + " cannot be " + typed, help, name + " " + value);
    }
    if (is<CLI::ExcludesError>(error)) {
        const std::string rest = message.substr(std::min(message.size(), message.find(name) + name.size()));
        const CLI::Option* other = option_in(app, rest);
        if (other != nullptr) usage(name + " and " + other->get_name() + " exclude each other", "give one of them");
    }
    if (is<CLI::ValidationError>(error)) {
        const std::size_t behind = message.find(": ");
        usage(name + ": " + (behind == std::string::npos ? message : message.substr(behind + 2)), help, name + " " + value);
    }
    usage(message, help);
}

void refuse_empty_values(const CLI::App& app, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::size_t sign = words[i].find('=');
        const std::string name = words[i].substr(0, sign);
        const CLI::Option* option = name.starts_with('-') ? app.get_option_no_throw(name) : nullptr;
        if (option == nullptr || option->get_items_expected_max() == 0) continue;
        const bool is_empty = sign == std::string::npos ? i + 1 < words.size() && words[i + 1].empty() : sign + 1 == words[i].size();
        if (is_empty) usage(name + " has an empty value", "give it a value, or omit it");
    }
}

void unknown_verb(const std::string& word) {
    std::vector<std::string> names{"help"};
    for (const Verb& verb : verbs()) names.push_back(verb.name);
    const auto other = std::ranges::find(kOtherWords, std::string_view(word), &std::pair<std::string_view, const char*>::first);
    const std::string near = other == kOtherWords.end() ? nearest(word, names) : other->second;
    usage("there is no verb \"" + word + "\"",
          near.empty() ? "isoatlas --help lists them" : "did you mean `isoatlas " + near + "`? isoatlas --help lists all verbs");
}

bool is_path(const std::string& word) {
    return word == "-" || word.find('/') != std::string::npos || !std::filesystem::path(word).extension().empty();
}

}  // namespace isoatlas::cli
