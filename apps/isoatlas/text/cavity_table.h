// The table of cavities, as text and as JSON.
#pragma once

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

class ObjectDirectory;
class Source;
class Terminal;

/// Members "cavity_branches" and "cavities": [...].
void add_cavities(Json& json, const CavityTable& table, const VolumeInfo& info, ObjectDirectory& directory);
/// The table alone, or with --json its own document.
void print_cavities(Terminal& terminal, const Arguments& arguments, Source& source, const CavityTable& table, ObjectDirectory& directory);

}  // namespace isoatlas::cli
