// The JSON document about a tree file.
#pragma once

#include "options/arguments.h"
#include "text/document.h"

namespace isoatlas::cli {

[[nodiscard]] const char* detail_name(TreeDetail detail);
/// Members of "isoatlas/tree-file/1" that every tree has.
[[nodiscard]] Json tree_file_document(const Arguments& arguments, const VolumeInfo& info, const Analysis& analysis);

}  // namespace isoatlas::cli
