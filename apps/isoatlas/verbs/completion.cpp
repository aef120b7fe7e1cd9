// isoatlas completion: completion scripts for bash, zsh and fish, generated from the parser itself.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr const char* kShells = "bash zsh fish";

/// "high|low|both": its words, with blanks between them; empty: any other value.
std::string choices_of(const DescribedOption& option) {
    const std::string& value = option.value;
    const auto is_choice = [](char c) { return c == '|' || c == '-' || std::islower(static_cast<unsigned char>(c)) != 0; };
    if (value.find('|') == std::string::npos || !std::ranges::all_of(value, is_choice)) return "";
    std::string words = value;
    std::ranges::replace(words, '|', ' ');
    return words;
}

/// For a word in single quotes.
std::string quoted(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result;
}

std::vector<std::string> words_of(const DescribedOption& option) {
    std::vector<std::string> words;
    for (const std::string& name : option.long_names) words.push_back("--" + name);
    for (const std::string& name : option.short_names) words.push_back("-" + name);
    return words;
}

// bash

std::string bash_case(const Verb& verb) {
    std::string names, values;
    for (const DescribedOption& option : described_options(verb.name)) {
        for (const std::string& name : option.long_names) names += "--" + name + " ";
        const std::string choices = choices_of(option);
        if (choices.empty()) continue;
        for (const std::string& name : option.long_names) values += fmt::format("                --{}) choices=\"{}\" ;;\n", name, choices);
    }
    std::string text = fmt::format("        {})\n            words=\"{}\"\n", verb.name, names);
    if (!values.empty()) text += "            case \"$before\" in\n" + values + "            esac\n";
    return text + "            ;;\n";
}

std::string bash_script() {
    std::string names, cases;
    for (const Verb& verb : verbs()) names += verb.name + " ", cases += bash_case(verb);
    return "# isoatlas completion for bash: source <(isoatlas completion bash)\n"
           "_isoatlas() {\n"
           "    local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\" words=\"\" choices=\"\"\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "        COMPREPLY=($(compgen -W \"" +
           names +
           "help\" -- \"$word\") $(compgen -f -- \"$word\"))\n"
           "        return\n"
           "    fi\n"
           "    case \"${COMP_WORDS[1]}\" in\n" +
           cases +
           "    esac\n"
           "    if [ -n \"$choices\" ]; then\n"
           "        COMPREPLY=($(compgen -W \"$choices\" -- \"$word\"))\n"
           "        return\n"
           "    fi\n"
           "    case \"$word\" in\n"
           "        -*) COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n"
           "        *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
           "    esac\n"
           "}\n"
           "complete -o filenames -F _isoatlas isoatlas\n";
}

// zsh

/// For descriptions in brackets, and for what lies before a colon.
std::string zsh_escaped(const std::string& text) {
    std::string result;
    for (const char c : quoted(text)) result += c == '[' || c == ']' || c == ':' ? std::string("\\") + c : std::string(1, c);
    return result;
}

std::string zsh_arguments(const Verb& verb) {
    std::string text;
    for (const DescribedOption& option : described_options(verb.name)) {
        const std::string choices = choices_of(option);
        const std::string value = option.value.empty() ? ""
                                  : choices.empty()    ? ":" + zsh_escaped(option.value) + ":_files"
                                                       : ":value:(" + choices + ")";
        for (const std::string& word : words_of(option))
            text += fmt::format("                '*{}[{}]{}' \\\n", word, zsh_escaped(option.meaning), value);
    }
    return text + "                '*:file:_files'\n";
}

std::string zsh_script() {
    std::string names, cases;
    for (const Verb& verb : verbs()) {
        names += fmt::format("        '{}:{}'\n", verb.name, zsh_escaped(verb.summary));
        cases += fmt::format("        {})\n            _arguments -S \\\n{}            ;;\n", verb.name, zsh_arguments(verb));
    }
    return "#compdef isoatlas\n"
           "# isoatlas completion for zsh: isoatlas completion zsh > _isoatlas, in a folder of $fpath\n"
           "_isoatlas() {\n"
           "    local -a isoatlas_verbs\n"
           "    isoatlas_verbs=(\n" +
           names +
           "    )\n"
           "    if (( CURRENT == 2 )); then\n"
           "        _describe -t verbs 'verb' isoatlas_verbs\n"
           "        _files\n"
           "        return\n"
           "    fi\n"
           "    local verb=$words[2]\n"
           "    shift words\n"
           "    (( CURRENT-- ))\n"
           "    case $verb in\n" +
           cases +
           "        *) _files ;;\n"
           "    esac\n"
           "}\n"
           "if [ \"$funcstack[1]\" = _isoatlas ]; then _isoatlas \"$@\"; else compdef _isoatlas isoatlas; fi\n";
}

// fish

std::string fish_text(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return result;
}

std::string fish_script() {
    std::string text = "# isoatlas completion for fish: isoatlas completion fish > ~/.config/fish/completions/isoatlas.fish\n";
    for (const Verb& verb : verbs()) {
        text += fmt::format("complete -c isoatlas -n __fish_use_subcommand -a {} -d '{}'\n", verb.name, fish_text(verb.summary));
        for (const DescribedOption& option : described_options(verb.name)) {
            text += fmt::format("complete -c isoatlas -n '__fish_seen_subcommand_from {}'", verb.name);
            for (const std::string& name : option.long_names) text += " -l " + name;
            for (const std::string& name : option.short_names) text += " -s " + name;
            const std::string choices = choices_of(option);
            if (!choices.empty()) text += fmt::format(" -x -a '{}'", choices);
            if (choices.empty() && !option.value.empty()) text += " -r";
            text += fmt::format(" -d '{}'\n", fish_text(option.meaning));
        }
    }
    return text;
}

}  // namespace

int run_completion(const Arguments& arguments, Terminal& terminal) {
    if (arguments.file == "bash") {
        terminal.out() << bash_script();
    } else if (arguments.file == "zsh") {
        terminal.out() << zsh_script();
    } else if (arguments.file == "fish") {
        terminal.out() << fish_script();
    } else {
        throw Error(
            ErrorKind::usage,
            {.what = "no completion for the shell \"" + arguments.file + "\"", .expected = kShells, .next = "isoatlas completion bash"});
    }
    return 0;
}

}  // namespace isoatlas::cli
