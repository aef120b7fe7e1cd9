// isoatlas VERB: which objects are in a volume, and at which isovalues?
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "arguments.h"
#include "interrupt.h"
#include "report.h"
#include "terminal.h"
#include "verbs.h"

namespace {

using isoatlas::Error;
using isoatlas::ErrorKind;
using namespace isoatlas::cli;

int run(const std::vector<std::string>& words, Terminal& terminal) {
    const Parsed parsed = parse(words);
    const Arguments& arguments = parsed.arguments;
    terminal.set_style({.quiet = arguments.quiet, .no_color = arguments.no_color, .verbose = arguments.verbose});
    int code = 0;
    if (!parsed.text.empty()) {
        terminal.out() << parsed.text;
    } else {
        code = find_verb(arguments.verb)->run(arguments, terminal);
    }
    terminal.finish();
    return code;
}

/// Whatever goes wrong becomes one Error.
int run_and_report(const std::vector<std::string>& words, Terminal& terminal) {
    const bool json = std::count(words.begin(), words.end(), "--json") > 0;
    try {
        return run(words, terminal);
    } catch (const Error& error) {
        return report(error, json, terminal);
    } catch (const std::bad_alloc&) {
        return report(
            Error(ErrorKind::resource,
                  {.what = "not enough memory", .next = "isoatlas info FILE tells what an analysis needs; use a machine with more memory"}),
            json, terminal);
    } catch (const std::exception& error) {
        return report(Error(ErrorKind::internal, {.what = std::string("a bug of isoatlas: ") + error.what(),
                                                  .next = "please report it with the command line and, if you may share it, the file"}),
                      json, terminal);
    }
}

}  // namespace

int main(int argc, char** argv) {
    catch_signals();
    Terminal terminal;
    return run_and_report({argv + 1, argv + argc}, terminal);
}
