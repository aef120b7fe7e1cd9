#include "atlas/lock_text.h"

#include <unistd.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "isoatlas/build.h"

namespace isoatlas {
namespace {

constexpr int kMaxPhases = 100;
constexpr std::size_t kLongestPhase = 64;

void put(std::string& text, double number) {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr) += ' ';
}

/// Parses a number and the following space.
template <class Number>
bool take(std::string_view& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end == text.data() + text.size() || *end != ' ') return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
    return true;
}

/// Negative: nullopt.
std::optional<double> known(double number) { return number >= 0 && std::isfinite(number) ? std::optional(number) : std::nullopt; }

}  // namespace

std::string lock_text(const std::optional<BuildState>& state) {
    std::string text = std::string(kBuildMark) + std::to_string(::getpid()) + "\n";
    if (!state) return text;
    text += std::to_string(state->phase_index) + ' ' + std::to_string(state->phase_count) + ' ' + std::to_string(state->peak_memory) + ' ';
    for (const double number : {state->fraction, state->seconds_left.value_or(-1), state->voxels_per_second.value_or(-1)})
        put(text, number);
    return text + state->phase.substr(0, kLongestPhase) + "\n";
}

bool has_mark(std::string_view text) { return text.starts_with(kBuildMark); }

bool is_blank(std::string_view text) { return text.find_first_not_of('\0') == text.npos; }

std::string holder_in(std::string_view text) {
    if (!has_mark(text)) return "";
    text.remove_prefix(kBuildMark.size());
    return std::string(text.substr(0, text.find('\n')));
}

BuildState state_in(std::string_view text) {
    if (!has_mark(text)) return {};
    text.remove_prefix(kBuildMark.size());
    const std::size_t first = text.find('\n'), last = first == text.npos ? first : text.find('\n', first + 1);
    if (last == text.npos) return {};
    std::string_view line = text.substr(first + 1, last - first - 1);
    BuildState state;
    double seconds = 0, rate = 0;
    const bool good = take(line, state.phase_index) && take(line, state.phase_count) && take(line, state.peak_memory) &&
                      take(line, state.fraction) && take(line, seconds) && take(line, rate);
    const bool possible = state.phase_count >= 1 && state.phase_count <= kMaxPhases && state.phase_index >= 0 &&
                          state.phase_index < state.phase_count && state.fraction >= 0 && state.fraction <= 1 && state.peak_memory >= 0;
    if (!good || !possible || line.size() > kLongestPhase) return {};
    state.seconds_left = known(seconds);
    state.voxels_per_second = known(rate);
    state.phase = line;
    return state;
}

}  // namespace isoatlas
