// Options of verbs that have many.
#pragma once

#include <CLI/CLI.hpp>

#include "arguments.h"
#include "selection_words.h"

namespace isoatlas::cli {

/// The range is told in the message of a failure, not in the help.
template <class T>
CLI::Validator in_range(T low, T high) {
    return CLI::Range(low, high).description("");
}

void add_picture(CLI::App& app, Arguments& arguments, PictureWords& words);
void add_camera(CLI::App& app, PictureWords& words);
void add_animation(CLI::App& app, Arguments& arguments);

/// Which objects are to be seen. top: also --top P%, where --top has no other meaning.
void add_selection(CLI::App& app, TypedSelection& typed, bool top);

}  // namespace isoatlas::cli
