#include "server/lines.h"

namespace isoatlas {
namespace {

constexpr int kMostWaiting = 256, kMostCards = 16;
constexpr std::array<const char*, 5> kNames{"surfaces", "samples", "trees", "cards", "atlas"};

}  // namespace

Lines::Lines(Changes& changes)
    : lines_{Turns{2, kMostWaiting, &changes}, Turns{2, kMostWaiting, &changes}, Turns{4, kMostWaiting, &changes},
             Turns{1, kMostCards, &changes}, Turns{kMostWaiting, kMostWaiting, &changes}} {}

void Lines::leave(const std::string& name) {
    for (Turns& line : lines_) line.leave(name);
}

void Lines::end() {
    for (Turns& line : lines_) line.end();
}

std::vector<Lines::Pending> Lines::pending(const std::string& name) const {
    std::vector<Pending> found;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        for (Turns::Pending& question : lines_[i].pending(name)) found.push_back({kNames[i], std::move(question)});
    }
    return found;
}

}  // namespace isoatlas
