#include "base/unfinished.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <mutex>

#include "isoatlas/output_file.h"

namespace isoatlas {
namespace {

/// Plain memory: a signal handler may neither allocate nor wait. More files at a time, or longer names, are not removed.
struct Slot {
    std::atomic<bool> used = false;
    std::array<char, 4096> path{};
};
constinit std::array<Slot, 16> slots;
constinit std::mutex changes;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

void note_unfinished(const std::string& path) {
    const std::lock_guard hold(changes);
    for (Slot& slot : slots) {
        if (slot.used || path.size() >= slot.path.size()) continue;
        std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
        slot.used = true;
        return;
    }
}

void forget_unfinished(const std::string& path) noexcept {
    const std::lock_guard hold(changes);
    for (Slot& slot : slots) {
        if (slot.used && path == slot.path.data()) slot.used = false;
    }
}

void remove_unfinished_files() noexcept {
    for (const Slot& slot : slots) {
        if (slot.used) (void)::unlink(slot.path.data());
    }
}

}  // namespace isoatlas
