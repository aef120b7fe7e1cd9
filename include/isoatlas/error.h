// Error: how isoatlas reports bad input, missing resources and failed guarantees.
//
// Bad input is a reported fact: what happened, in which file and where, what was expected, what to do next.
// Every public function may throw isoatlas::Error and nothing else of ours; a bug is a failed check (kind internal).
#pragma once

#include <stdexcept>
#include <string>

namespace isoatlas {

/// Kind of failure; the value is the exit code of the command line.
enum class ErrorKind : int {
    internal = 1,      ///< a check of isoatlas itself failed: a bug
    usage = 2,         ///< a contradictory or invalid request of the caller
    input = 3,         ///< a file is missing, unreadable, truncated or corrupt
    unsupported = 4,   ///< a valid file of a format or type that isoatlas does not read
    resource = 5,      ///< output cannot be written, disk full, not enough memory
    not_found = 6,     ///< no such object or contour, isovalue outside the range
    verification = 7,  ///< a guarantee does not hold for this mesh or volume
    cancelled = 130    ///< stopped by the user
};

/// The parts of an error message. Empty parts are left out.
struct ErrorText {
    std::string file{};      ///< path of the file concerned
    std::string where{};     ///< offset, line, field or voxel
    std::string what{};      ///< what happened
    std::string expected{};  ///< what was expected instead
    std::string next{};      ///< what the user can do
};

/// "FILE: WHERE: WHAT (expected EXPECTED). Next: NEXT"
[[nodiscard]] std::string describe(const ErrorText& text);

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, ErrorText text);
    [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
    [[nodiscard]] const ErrorText& text() const noexcept { return text_; }

private:
    ErrorKind kind_;
    ErrorText text_;
};

}  // namespace isoatlas
