// Several things in one file: what there is, with the command for each.
#pragma once

#include <string>
#include <vector>

#include <isoatlas/error.h>

#include "text/document.h"

namespace isoatlas::cli {

struct ChoiceCommand {
    std::string word, about, command;
};

/// The words of the command line again, with each choice of an error (ErrorText::choices); empty: there is none.
[[nodiscard]] std::vector<ChoiceCommand> commands_of(const Error& error, const std::vector<std::string>& words);
/// One line for each, aligned.
[[nodiscard]] std::string lines_of(const std::vector<ChoiceCommand>& choices);
[[nodiscard]] Json json_of(const std::vector<ChoiceCommand>& choices);

}  // namespace isoatlas::cli
