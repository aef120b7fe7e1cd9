// `-` in the place of a file: a volume from standard input, `-o -` a result to standard output.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "data/temporary_folder.h"
#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// Puts files of a folder of its own, which it removes, in the place of `-`: readers and writers of most formats seek.
class Piped {
public:
    /// Reads standard input to its end. Throws Error: usage (a verb that cannot, standard input is a terminal, --json beside -o -),
    /// resource.
    Piped(Arguments& arguments, Terminal& terminal);

    /// With `-o -` what the verb prints becomes messages, and its file goes to standard output where it succeeds.
    [[nodiscard]] int run(const std::function<int()>& verb);

private:
    /// With the names that the user knows.
    [[nodiscard]] Error renamed(const Error& error) const;
    [[nodiscard]] const std::string& folder();
    void read_input(Arguments& arguments);
    void take_output(Arguments& arguments);

    Terminal& terminal_;
    std::optional<TemporaryFolder> folder_;
    std::string input_, output_;
};

}  // namespace isoatlas::cli
