// The command line: isoatlas VERB.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <fmt/format.h>

#include "data/assume_inputs.h"
#include "data/network.h"
#include "data/piped.h"
#include "data/several.h"
#include "data/sides.h"
#include "options/arguments.h"
#include "text/failure.h"
#include "text/interrupt.h"
#include "text/report.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace {

using isoatlas::Error;
using isoatlas::ErrorKind;
using namespace isoatlas::cli;
using Clock = std::chrono::steady_clock;

void tell_resources(Terminal& terminal, Clock::time_point start) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const std::chrono::duration<double> seconds = Clock::now() - start;
    terminal.detail(fmt::format("took {:.2f} s, peak memory {}", seconds.count(), bytes_text(1024 * static_cast<double>(usage.ru_maxrss))));
}

int run(const std::vector<std::string>& words, Terminal& terminal) {
    const Clock::time_point start = Clock::now();
    Parsed parsed = parse(words);
    Arguments& arguments = parsed.arguments;
    terminal.set_style({.quiet = arguments.quiet, .no_color = arguments.no_color, .verbose = arguments.verbose});
    int code = 0;
    if (!parsed.text.empty()) {
        terminal.out() << parsed.text;
    } else {
        use_network(arguments);
        Piped piped(arguments, terminal);
        choose_one(arguments);
        if (!builds_all(arguments)) {  // which does it for each volume
            assume_inputs(arguments, terminal);
            arguments = with_sides(arguments);
        }
        const Verb& verb = *find_verb(arguments.verb);
        code = piped.run([&] {
            return runs_for_each_polarity(arguments) ? run_for_each_polarity(verb, arguments, terminal) : verb.run(arguments, terminal);
        });
    }
    terminal.finish();
    tell_traffic(terminal);
    tell_resources(terminal, start);
    return code;
}

/// Adds the next step to usage errors, and the state of the output to an interrupt.
Error completed(const Error& error, const std::vector<std::string>& words) {
    isoatlas::ErrorText text = error.text();
    if (error.kind() == ErrorKind::cancelled) text.what = "stopped; nothing was written";
    if (error.kind() == ErrorKind::usage && text.next.empty()) {
        const auto verb = std::find_if(words.begin(), words.end(), [](const std::string& word) { return find_verb(word) != nullptr; });
        text.next = verb == words.end() ? "isoatlas --help" : "isoatlas " + *verb + " --help";
    }
    return {error.kind(), text};
}

/// Converts every exception to an Error.
int run_and_report(const std::vector<std::string>& words, Terminal& terminal) {
    const bool json = std::count(words.begin(), words.end(), "--json") > 0;
    try {
        return run(words, terminal);
    } catch (...) {
        terminal.forget();
        return report(completed(failure(), words), words, json, terminal);
    }
}

/// Runs before static initialisation of other files and main().
[[gnu::constructor(101)]] void prepare_for_the_worst() { end_with_exit_codes(); }

}  // namespace

int main(int argc, char** argv) {
    catch_signals();
    Terminal terminal;
    if (argc > 0) terminal.set_program(argv[0]);
    return run_and_report({argv + 1, argv + argc}, terminal);
}
