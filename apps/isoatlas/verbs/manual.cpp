// isoatlas manual: manual pages in the macros of man(7), generated from the parser itself.
#include <fmt/format.h>
#include <isoatlas/version.h>

#include "options/parse_errors.h"
#include "text/terminal.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Backslashes, and dashes that are typed; a line must not begin with a request.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string head(const std::string& name, const std::string& summary) {
    return fmt::format(".TH {} 1 \"\" \"isoatlas {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", escaped(name), ISOATLAS_VERSION,
                       escaped(name), escaped(summary));
}

std::string synopsis(const std::string& words, const std::string& operand) {
    return fmt::format(".SH SYNOPSIS\n.B {}\n{} [\\fIOPTION\\fR]...\n", escaped(words),
                       operand.empty() ? "" : "\\fI" + escaped(operand) + "\\fR");
}

std::string options_text(const std::string& verb) {
    std::string text, group;
    for (const DescribedOption& option : described_options(verb)) {
        if (option.group != group) text += fmt::format(".SH {}\n", escaped(option.group)), group = option.group;
        std::string names;
        const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + ("\\fB" + escaped(name) + "\\fR"); };
        for (const std::string& name : option.short_names) add("-" + name);
        for (const std::string& name : option.long_names) add("--" + name);
        if (!option.value.empty()) names += " \\fI" + escaped(option.value) + "\\fR";
        text += ".TP\n" + names + "\n" + escaped(option.meaning) + (option.is_required ? " (required)" : "") + "\n";
    }
    return text;
}

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    "0 done, 1 bug, 2 usage, 3 input damaged or missing, 4 format not supported, 5 cannot write or out of memory, 6 no such object or\n"
    "isovalue, 7 a guarantee does not hold, 130 interrupted.\n";

std::string page_of(const Verb& verb) {
    std::string text = head("isoatlas-" + verb.name, verb.summary) + synopsis("isoatlas " + verb.name, verb.operand);
    text += options_text(verb.name) + ".SH EXAMPLES\n.nf\n";
    for (const std::string& example : verb.examples) text += escaped(example) + "\n";
    return text + ".fi\n" + kExitStatus + ".SH SEE ALSO\n\\fBisoatlas\\fR(1)\n";
}

std::string overview_page() {
    std::string text = head("isoatlas", "which objects are in a volume, and at which isovalues?");
    text +=
        ".SH SYNOPSIS\n.B isoatlas\n\\fIVOLUME\\fR\n.br\n.B isoatlas\n\\fIVERB\\fR [\\fIVOLUME\\fR] [\\fIOPTION\\fR]...\n.SH DESCRIPTION\n"
        "\\fBisoatlas\\fR lists the topologically distinct objects of a scalar volume (CT, MRI, microscopy, simulations) with the "
        "isovalues\n"
        "that show them, draws them, and writes their surfaces, watertight. \\fBisoatlas\\fR \\fIVOLUME\\fR writes a page of pictures.\n"
        "Results go to standard output, messages to standard error. A volume \\fB\\-\\fR is read from standard input, \\fB\\-o \\-\\fR "
        "writes\n"
        "to standard output.\n";
    for (const VerbGroup& group : verb_groups()) {
        text += ".SH " + group.title + "\n";
        for (const char* name : group.verbs) {
            const Verb& verb = *find_verb(name);
            text += fmt::format(".TP\n\\fB{}\\fR \\fI{}\\fR\n{}\n", verb.name, escaped(verb.operand), escaped(verb.summary));
        }
    }
    text += std::string(kExitStatus) + ".SH SEE ALSO\n";
    for (const Verb& verb : verbs()) text += fmt::format("\\fBisoatlas\\-{}\\fR(1)\n", verb.name);
    return text;
}

}  // namespace

int run_manual(const Arguments& arguments, Terminal& terminal) {
    if (arguments.file.empty()) {
        terminal.out() << overview_page();
        return 0;
    }
    const Verb* verb = find_verb(arguments.file);
    if (verb == nullptr) unknown_verb(arguments.file);
    terminal.out() << page_of(*verb);
    return 0;
}

}  // namespace isoatlas::cli
