// The target of an output, and whether it may be written (isoatlas/output_file.h).
#pragma once

#include <string>

#include "base/file_system.h"
#include "isoatlas/error.h"

namespace isoatlas {

struct OutputTarget {
    std::string path;        ///< links followed
    FileStatus status{};     ///< of that file: regular or missing
    bool is_stream = false;  ///< what the process has open already
};

/// Why an output cannot be written, and the next step of a user. It can: `what` is empty.
struct Obstacle {
    std::string what{}, next{};
    Reason reason = Reason::none;
};

/// Resolves `path`; `obstacle` says why nothing may be written there.
[[nodiscard]] OutputTarget find_target(const std::string& path, Obstacle& obstacle);
/// The same; throws Error{resource} when there is an obstacle.
[[nodiscard]] OutputTarget require_target(const std::string& path);

/// What a user can do when writing fails with -errno.
[[nodiscard]] std::string next_step_after(int error);
[[nodiscard]] Reason reason_after(int error);

}  // namespace isoatlas
