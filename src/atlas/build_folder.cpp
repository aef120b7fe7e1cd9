#include "atlas/build_folder.h"

#include <cerrno>
#include <cstring>
#include <limits>

#include "atlas/lock_text.h"
#include "base/atomic_file.h"
#include "io/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr const char* kLock = "lock";
constexpr std::chrono::seconds kSayEvery{1};

[[noreturn]] void cannot_make(const std::string& path, int error) {
    const char* in_the_way = "choose another folder with -o, or remove what is in the way";
    throw Error(ErrorKind::resource, {.file = path,
                                      .what = std::string("the folder for the build cannot be made: ") + std::strerror(-error),
                                      .next = error == -ENOTDIR ? in_the_way : next_step_after(error)});
}

/// Removes all but the lock. What cannot be removed stays: it is replaced when it is in the way.
void remove_contents(const std::string& path) {
    for (const std::string& name : file_system().entries(path, std::numeric_limits<std::size_t>::max())) {
        if (name != kLock) (void)file_system().remove(path + "/" + name);
    }
}

/// What is in a lock; "" when that cannot be read.
std::string text_of(const std::string& lock) try {
    std::string text(kLockBytes, '\0');
    text.resize(io::read_available(*io::open_file(lock), lock, 0, std::as_writable_bytes(std::span(text))));
    return text;
} catch (const Error&) {
    return "";
}

/// Does a phase belong to the same samples, and are its arrays what this version would make?
bool belongs(const store::Contents& found, const store::Contents& wanted) {
    return found.version == wanted.version && found.volume.extent == wanted.volume.extent && found.volume.type == wanted.volume.type &&
           found.parameters.interpolant == wanted.parameters.interpolant &&
           found.parameters.tunnel_height == wanted.parameters.tunnel_height &&
           found.parameters.samples_checksum == wanted.parameters.samples_checksum;
}

}  // namespace

BuildFolder::BuildFolder(const std::string& store_path, bool restart) : path_(store_path + ".build") {
    OpenedFile lock{nullptr, -ENOENT};
    for (int attempt = 0; attempt < 3 && lock.error == -ENOENT; ++attempt) {  // a build that has just finished takes its folder away
        const int made = file_system().make_folder(path_);
        if (made < 0 && made != -EEXIST) cannot_make(path_, made);
        lock = file_system().create(file(kLock));
    }
    if (lock.error == -EWOULDBLOCK) {
        const std::string who = holder_in(text_of(file(kLock)));
        throw Error(ErrorKind::resource, {.file = store_path,
                                          .what = "is being built by another process" + (who.empty() ? "" : ", " + who),
                                          .next = "wait until it is done, or build to another file with -o"});
    }
    if (!lock.file) cannot_make(path_, lock.error);
    lock_ = std::move(lock.file);
    const std::string own = lock_text(std::nullopt);
    if (const int error = write_fully(*lock_, 0, std::as_bytes(std::span(own))); error < 0) cannot_make(path_, error);
    if (restart) remove_contents(path_);
}

BuildFolder::~BuildFolder() {
    if (lock_ && file_system().entries(path_, 2).size() == 1) (void)remove();  // the lock alone: nothing was finished
}

std::unique_ptr<store::Container> BuildFolder::finished(const std::string& phase, const store::Contents& wanted) const {
    if (!io::file_exists(file(phase))) return nullptr;
    try {
        auto container = std::make_unique<store::Container>(file(phase));
        if (belongs(container->contents(), wanted)) {
            container->check_all();
            return container;
        }
    } catch (const Error&) {  // damaged: it is made again
    }
    (void)file_system().remove(file(phase));
    return nullptr;
}

void BuildFolder::say(const BuildState& state) {
    const auto now = std::chrono::steady_clock::now();
    if (now - said_ < kSayEvery) return;
    said_ = now;
    const std::string text = lock_text(state);
    (void)write_fully(*lock_, 0, std::as_bytes(std::span(text)));
}

bool BuildFolder::remove() {
    remove_contents(path_);
    (void)file_system().remove(file(kLock));  // while it is held: whoever waits for it makes a new one
    const bool gone = file_system().remove_folder(path_) == 0;
    lock_.reset();
    return gone;
}

std::optional<BuildState> build_state(const std::string& path) {
    const std::string lock = path + ".build/" + kLock;
    if (!file_system().is_held(lock)) return std::nullopt;
    return state_in(text_of(lock));
}

}  // namespace isoatlas
