#include "text/choices.h"

#include <algorithm>

#include <fmt/format.h>
#include <isoatlas/shell_word.h>

namespace isoatlas::cli {
namespace {

/// The option that chooses; "": the name of the file does, FILE:/DATASET. nullptr: nothing is chosen.
const char* option_of(Reason reason) {
    switch (reason) {
        case Reason::channel_needed:
        case Reason::no_such_channel: return "--channel";
        case Reason::series_needed:
        case Reason::no_such_series: return "--series";
        case Reason::dataset_needed:
        case Reason::no_such_dataset: return "";
        default: return nullptr;
    }
}

/// The words with the option, in place of the one that is there.
std::vector<std::string> with_option(const std::vector<std::string>& words, const std::string& option, const std::string& value) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == option)
            ++i;
        else if (!words[i].starts_with(option + "="))
            result.push_back(words[i]);
    }
    result.insert(result.end(), {option, value});
    return result;
}

std::vector<std::string> with_dataset(std::vector<std::string> words, const std::string& file, const std::string& dataset) {
    for (std::string& word : words) {
        if (word == file || word.starts_with(file + ":/")) word = file + ":" + (dataset.starts_with('/') ? "" : "/") + dataset;
    }
    return words;
}

}  // namespace

std::vector<ChoiceCommand> commands_of(const Error& error, const std::vector<std::string>& words) {
    const ErrorText& text = error.text();
    const char* option = option_of(text.reason);
    std::vector<ChoiceCommand> commands;
    if (option == nullptr) return commands;
    for (const ErrorChoice& choice : text.choices) {
        std::string command = "isoatlas";
        for (const std::string& word : *option == 0 ? with_dataset(words, text.file, choice.word) : with_option(words, option, choice.word))
            command += " " + shell_word(word);
        commands.push_back({choice.word, choice.about, command});
    }
    return commands;
}

std::string lines_of(const std::vector<ChoiceCommand>& choices) {
    std::size_t width = 0;
    for (const ChoiceCommand& choice : choices) width = std::max(width, std::min<std::size_t>(choice.command.size(), 100));
    std::string lines;
    for (const ChoiceCommand& choice : choices) lines += fmt::format("  {:{}}  {}\n", choice.command, width, choice.about);
    return lines;
}

Json json_of(const std::vector<ChoiceCommand>& choices) {
    Json list = Json::array();
    for (const ChoiceCommand& choice : choices)
        list.push_back({{"word", choice.word}, {"about", choice.about}, {"command", choice.command}});
    return list;
}

}  // namespace isoatlas::cli
