// The simplified tree, as text, as JSON and as a file, and the objects that a selection hides.
#pragma once

#include "options/arguments.h"

namespace isoatlas::cli {

class Source;
class Terminal;

/// isoatlas tree with a selection.
int run_simplified_tree(const Arguments& arguments, Terminal& terminal);
/// Writes arguments.curve.
void write_curves(const Arguments& arguments, Source& source);
/// "3 of 1,204 objects are shown; the others hold 2 % of the voxels"
[[nodiscard]] std::string hidden_text(const Simplified& simplified, std::int64_t voxels);

}  // namespace isoatlas::cli
