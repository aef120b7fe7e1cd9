#include "formats/volume/choose.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "formats/common/text.h"

namespace isoatlas {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what, std::span<const ErrorChoice> choices, const std::string& next,
                         Reason reason) {
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = what,
                                   .expected = (choices.size() == 1 ? "" : "one of ") + first_of(choices, &ErrorChoice::word),
                                   .next = next,
                                   .reason = reason,
                                   .choices = {choices.begin(), choices.end()}});
}

/// An exact word, else the only one that differs in case alone, else a number from 0.
std::optional<std::size_t> find_word(std::span<const std::string> words, const std::string& word) {
    const auto exact = std::ranges::find(words, word);
    if (exact != words.end()) return exact - words.begin();
    const auto same = [&](const std::string& other) { return lower(other) == lower(word); };
    if (!word.empty() && std::ranges::count_if(words, same) == 1) return std::ranges::find_if(words, same) - words.begin();
    const std::optional<std::int64_t> number = parse_integer(word);
    if (!number || *number < 0 || *number >= static_cast<std::int64_t>(words.size())) return std::nullopt;
    return static_cast<std::size_t>(*number);
}

std::string without_slash(const std::string& word) { return word.starts_with('/') ? word.substr(1) : word; }

/// What an option chooses, and why it cannot.
struct Chooser {
    const char* one;   ///< "channel"
    const char* many;  ///< "channels"
    Reason needed, missing, none;
};

std::size_t choose(const std::string& path, const std::optional<std::string>& wanted, std::span<const ErrorChoice> choices,
                   std::span<const std::string> words, const Chooser& of) {
    if (!wanted) {
        if (words.size() == 1) return 0;
        refuse(path, "holds " + std::to_string(words.size()) + " " + of.many, choices, std::string("choose a ") + of.one, of.needed);
    }
    if (const std::optional<std::size_t> found = find_word(words, *wanted)) return *found;
    refuse(path, std::string("has no ") + of.one + " \"" + *wanted + "\"", choices,
           words.size() == 1 ? std::string("leave the ") + of.one + " out" : std::string("choose another ") + of.one,
           words.size() == 1 ? of.none : of.missing);
}

}  // namespace

TimeStep choose_time_step(const std::string& path, const OpenOptions& options, std::int64_t count) {
    const std::int64_t index = options.time_step.value_or(0);
    if (count > 1 && !options.time_step) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "holds " + std::to_string(count) + " volumes (4 dimensions)",
                                       .expected = "one volume",
                                       .next = "choose a time step from 0 to " + std::to_string(count - 1),
                                       .reason = Reason::time_step_needed,
                                       .value = std::to_string(count - 1)});
    }
    if (index < 0 || index >= count) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "has no time step " + std::to_string(index),
                                       .expected = count == 1 ? "0: there is one volume" : "0 to " + std::to_string(count - 1),
                                       .next = count == 1 ? "omit the time step" : "choose another time step",
                                       .reason = count == 1 ? Reason::no_time_steps : Reason::no_such_time_step,
                                       .value = std::to_string(count - 1)});
    }
    return {index, count};
}

std::int64_t choose_channel(const std::string& path, const OpenOptions& options, std::span<const std::string> names) {
    std::vector<ErrorChoice> choices;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_unique = !names[i].empty() && std::ranges::count(names, names[i]) == 1;
        const std::string number = std::to_string(i);
        choices.push_back(is_unique ? ErrorChoice{names[i], "channel " + number} : ErrorChoice{number, "channel " + names[i]});
    }
    constexpr Chooser kChannel{"channel", "channels", Reason::channel_needed, Reason::no_such_channel, Reason::no_channels};
    return static_cast<std::int64_t>(choose(path, options.channel, choices, names, kChannel));
}

std::int64_t choose_level(const std::string& path, const OpenOptions& options, std::int64_t count) {
    const std::int64_t level = options.level.value_or(0);
    if (level >= 0 && level < count) return level;
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = "has no resolution level " + std::to_string(level),
                                   .expected = count == 1 ? "0: there is one level" : "0 to " + std::to_string(count - 1),
                                   .next = count == 1 ? "omit the level" : "choose another level",
                                   .reason = Reason::no_such_level,
                                   .value = std::to_string(count - 1)});
}

std::size_t choose_dataset(const std::string& path, const OpenOptions& options, std::span<const ErrorChoice> choices) {
    std::vector<std::string> words;
    for (const ErrorChoice& choice : choices) words.push_back(without_slash(choice.word));
    std::optional<std::string> wanted = options.dataset;
    if (wanted) wanted = without_slash(*wanted);
    constexpr Chooser kDataset{"dataset", "datasets", Reason::dataset_needed, Reason::no_such_dataset, Reason::no_such_dataset};
    return choose(path, wanted, choices, words, kDataset);
}

std::size_t choose_series(const std::string& path, const OpenOptions& options, std::span<const ErrorChoice> choices) {
    std::vector<std::string> words;
    for (const ErrorChoice& choice : choices) words.push_back(choice.word);
    constexpr Chooser kSeries{"series", "series", Reason::series_needed, Reason::no_such_series, Reason::no_such_series};
    return choose(path, options.series, choices, words, kSeries);
}

}  // namespace isoatlas
