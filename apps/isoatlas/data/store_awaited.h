// The store that a viewer shows: there already, built now, or built by another process while the viewer waits.
#pragma once

#include <functional>
#include <string>

#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// Where the store is: arguments.file, or in the current folder.
[[nodiscard]] std::string store_to_view(const Arguments& arguments);

/// Throws Error{usage} unless it is 3D.
void check_is_volume(const Arguments& arguments, const VolumeInfo& info);

/// Can it be opened at once? Says so where it stands beside a volume. Throws Error when it will never be there: no such file, or an image,
/// a volume without a store and --read-only.
[[nodiscard]] bool is_ready(const Arguments& arguments, Terminal& terminal, const std::string& store);

/// Returns when the store is there: builds it, or waits for the process that does so, and goes on where that one has stopped. tell: where
/// the build is, some times a second. Throws Error; cancelled when it is interrupted.
void await_store(const Arguments& arguments, Terminal& terminal, const std::string& store,
                 const std::function<void(const BuildState&)>& tell);

}  // namespace isoatlas::cli
