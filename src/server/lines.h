// The lines in which questions wait, by what their answers are made of.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "server/turns.h"

namespace isoatlas {

enum class Line : std::uint8_t {
    surfaces,  ///< surfaces, labels, measures
    samples,   ///< of bricks that are read
    trees,     ///< what the trees tell
    cards,     ///< pictures; they have time
    atlas,     ///< no line: all wait for the same
};

class Lines {
public:
    /// changes: is told of every change; it must live as long.
    explicit Lines(Changes& changes);

    [[nodiscard]] Turns& of(Line line) { return lines_[static_cast<std::size_t>(line)]; }
    /// Turns::leave() and end() of all.
    void leave(const std::string& name);
    void end();

    struct Pending {
        const char* line;  ///< "surfaces", ...
        Turns::Pending question;
    };
    /// Turns::pending() of all, one line after the other.
    [[nodiscard]] std::vector<Pending> pending(const std::string& name) const;

private:
    std::array<Turns, 5> lines_;
};

}  // namespace isoatlas
