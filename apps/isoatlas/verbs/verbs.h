// The verbs of the command line, one file each. A verb returns the exit code or throws Error.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "options/arguments.h"

namespace isoatlas::cli {

class Source;
class Terminal;

int run_atlas(const Arguments& arguments, Terminal& terminal);
int run_serve(const Arguments& arguments, Terminal& terminal);
int run_view(const Arguments& arguments, Terminal& terminal);
int run_info(const Arguments& arguments, Terminal& terminal);
int run_tree(const Arguments& arguments, Terminal& terminal);
int run_objects(const Arguments& arguments, Terminal& terminal);
int run_measure(const Arguments& arguments, Terminal& terminal);
int run_extract(const Arguments& arguments, Terminal& terminal);
/// Says once that a page has its first pictures (PageOptions::partly_written).
[[nodiscard]] std::function<void(std::int64_t)> tell_first_pictures(Terminal& terminal, const std::string& page);
/// `objects` and `extract` of a label volume.
int list_label_objects(const Arguments& arguments, Terminal& terminal);
int extract_label_objects(const Arguments& arguments, Terminal& terminal);
/// The page and `label` of a label volume.
int run_label_page(const Arguments& arguments, Terminal& terminal);
int label_label_objects(const Arguments& arguments, Terminal& terminal);
/// objects --polarity both.
int run_objects_of_both(const Arguments& arguments, Terminal& terminal);
int run_render(const Arguments& arguments, Terminal& terminal);
int run_animate(const Arguments& arguments, Terminal& terminal);
/// animate -o FILE.vtkhdf. isovalues: those of the command line, stored.
int animate_surfaces(const Arguments& arguments, Terminal& terminal, const std::function<std::vector<double>(Source&)>& isovalues);
/// Build options of a volume.
[[nodiscard]] BuildOptions build_options(const Arguments& arguments, const VolumeInfo& info);
/// Builds arguments.output and prints its notes. watch: receives the progress too; may be empty. high_values: BuildOptions::high_values.
BuildReport build_store(const Arguments& arguments, Terminal& terminal, VolumeReader& reader,
                        const std::function<void(const Progress&)>& watch = {},
                        const std::function<void(const std::string&, const Context&)>& high_values = {});
int run_build(const Arguments& arguments, Terminal& terminal);
/// build --all: its inputs are not assumed yet, as those of each volume are of their own.
[[nodiscard]] bool builds_all(const Arguments& arguments);
int run_build_all(const Arguments& arguments, Terminal& terminal);
int run_name(const Arguments& arguments, Terminal& terminal);
int run_label(const Arguments& arguments, Terminal& terminal);
int run_convert(const Arguments& arguments, Terminal& terminal);
int run_phantom(const Arguments& arguments, Terminal& terminal);
int run_handles(const Arguments& arguments, Terminal& terminal);
int run_spectrum(const Arguments& arguments, Terminal& terminal);
int run_compare(const Arguments& arguments, Terminal& terminal);
int run_table131(const Arguments& arguments, Terminal& terminal);
int run_ask(const Arguments& arguments, Terminal& terminal);
int run_levels(const Arguments& arguments, Terminal& terminal);
int run_dump(const Arguments& arguments, Terminal& terminal);
int run_verify(const Arguments& arguments, Terminal& terminal);
int run_completion(const Arguments& arguments, Terminal& terminal);
int run_manual(const Arguments& arguments, Terminal& terminal);

struct Verb {
    std::string name, operand, summary;
    std::vector<std::string> examples;  ///< full command lines
    int (*run)(const Arguments&, Terminal&);
    std::string terms{};  ///< below the examples: what words of its output mean
};

/// In the order of the help.
[[nodiscard]] const std::vector<Verb>& verbs();

struct VerbGroup {
    std::string title;
    std::vector<const char*> verbs;
};
/// Every verb is in one of them.
[[nodiscard]] const std::vector<VerbGroup>& verb_groups();

/// --polarity both of a verb about one polarity, not about the list of both.
[[nodiscard]] bool runs_for_each_polarity(const Arguments& arguments);
/// Runs it for high and for low values: two parts in one text, one document ("isoatlas/both/1"), or two files (FILE-high.csv,
/// FILE-low.csv). Nothing is printed and no file is left where one of them fails. Returns the greater exit code.
int run_for_each_polarity(const Verb& verb, const Arguments& arguments, Terminal& terminal);

/// nullptr when there is no such verb.
[[nodiscard]] const Verb* find_verb(const std::string& name);

/// Output of `isoatlas` alone, and of `isoatlas --help`.
[[nodiscard]] std::string greeting();
[[nodiscard]] std::string overview();

}  // namespace isoatlas::cli
