// The store of a viewer: it exists, is built now, or is built by another process while the viewer waits.
#pragma once

#include <functional>
#include <string>

#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// Path of the store: arguments.file, or a file in the current folder.
[[nodiscard]] std::string store_to_view(const Arguments& arguments);

/// Throws Error{usage} unless it is 3D.
void check_is_volume(const Arguments& arguments, const VolumeInfo& info);

/// Can it be opened at once? Prints a note when it stands beside a volume. Throws Error when it can never be opened: no such file, a 2D
/// image, or a volume without a store and --read-only.
[[nodiscard]] bool is_ready(const Arguments& arguments, Terminal& terminal, const std::string& store);

/// Returns when the store exists: builds it, or waits for the process that does, and resumes the build if that process stops. tell: called
/// with the progress several times a second. Throws Error; cancelled on an interrupt.
void await_store(const Arguments& arguments, Terminal& terminal, const std::string& store,
                 const std::function<void(const BuildState&)>& tell);

}  // namespace isoatlas::cli
