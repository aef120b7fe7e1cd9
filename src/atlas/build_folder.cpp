#include "atlas/build_folder.h"

#include <cerrno>
#include <cstring>
#include <limits>

#include "atlas/lock_text.h"
#include "base/check.h"
#include "base/output_target.h"
#include "base/temporary_name.h"
#include "formats/common/file_access.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "store/container.h"

namespace isoatlas {
namespace {

constexpr const char* kLock = "lock";
constexpr std::chrono::seconds kSayEvery{1};
constexpr const char* kOtherFile = "rename or remove it, or build to another file";

[[noreturn]] void cannot_make(const std::string& path, int error) {
    const bool is_taken = error == -ENOTDIR;
    throw Error(ErrorKind::resource, {.file = path,
                                      .what = std::string("cannot create the folder of the build: ") + std::strerror(-error),
                                      .next = is_taken ? kOtherFile : next_step_after(error),
                                      .reason = is_taken ? Reason::build_folder_taken : reason_after(error)});
}

[[noreturn]] void not_ours(const std::string& path, const std::string& what) {
    throw Error(ErrorKind::resource, {.file = path,
                                      .what = what,
                                      .expected = "the folder that a build makes for itself",
                                      .next = kOtherFile,
                                      .reason = Reason::build_folder_taken});
}

/// Names of the phases of either polarity, of the store that is lent between them (atlas/build.cpp), and of surfaces (levels/levels.cpp).
bool is_phase(std::string_view name) {
    if (name == "high-values" || name.starts_with("surface-")) return true;
    if (name.starts_with("low-")) name.remove_prefix(4);
    return name == "trees" || name == "zones";
}

/// Removes the files of builds except the lock. Files that cannot be removed are replaced later.
void remove_contents(const std::string& path) {
    for (const std::string& name : file_system().entries(path, std::numeric_limits<std::size_t>::max())) {
        if (is_phase(name)) (void)file_system().remove(path + "/" + name);
        if (is_temporary_name(name)) file_system().remove_abandoned(path + "/" + name);
    }
}

/// Accepts only folders of this user that are empty or have a lock.
void check_found(const std::string& path) {
    using Kind = FileStatus::Kind;
    const FileStatus found = file_system().status_of_name(path);
    if (found.kind == Kind::missing) return;
    if (found.kind == Kind::link) not_ours(path, "is a link");
    if (found.kind != Kind::folder) not_ours(path, "is not a folder");
    if (!found.own) not_ours(path, "belongs to another user");
    const bool is_empty = file_system().entries(path, 1).empty();
    if (!is_empty && file_system().status_of_name(path + "/" + kLock).kind == Kind::missing)
        not_ours(path, "was not made by a build; nothing in it was touched");
}

std::string text_of(File& lock, const std::string& path) {
    std::string text(kLockBytes, '\0');
    text.resize(read_available(lock, path, 0, std::as_writable_bytes(std::span(text))));
    return text;
}

/// Text of the lock of another process; "" when it cannot be read.
std::string text_of(const std::string& lock) try { return text_of(*open_file(lock), lock); } catch (const Error&) {
    return "";
}

}  // namespace

BuildFolder::BuildFolder(const std::string& store_path, bool restart) : path_(require_target(store_path).path + ".build") {
    lock(store_path);
    mark();
    if (restart) remove_contents(path_);
}

void BuildFolder::lock(const std::string& store_path) {
    OpenedFile lock{nullptr, -ENOENT};
    for (int attempt = 0; attempt < 3 && lock.error == -ENOENT; ++attempt) {  // a build that has just finished removes its folder
        const int made = file_system().make_folder(path_);
        if (made < 0 && made != -EEXIST) cannot_make(path_, made);
        if (made == -EEXIST) check_found(path_);
        lock = file_system().lock(file(kLock));
    }
    if (lock.error == -EWOULDBLOCK) {
        const std::string who = holder_in(text_of(file(kLock)));
        throw Error(ErrorKind::resource, {.file = store_path,
                                          .what = "is being built by another process" + (who.empty() ? "" : ", " + who),
                                          .next = "wait until it is done, or build to another file",
                                          .reason = Reason::store_being_built});
    }
    if (lock.error == -EPERM) not_ours(file(kLock), "is a link, not a regular file, or one with other hard links or of another user");
    if (!lock.file) cannot_make(path_, lock.error);
    lock_ = std::move(lock.file);
}

/// Marks the folder as that of a build, if it is not; requires the lock.
void BuildFolder::mark() {
    const std::string found = text_of(*lock_, file(kLock));
    const bool is_new = is_blank(found) && file_system().entries(path_, 2).size() == 1;
    if (!is_new && !has_mark(found)) {
        lock_.reset();
        not_ours(path_, "was not made by a build of this version; nothing in it was touched");
    }
    const std::string own = lock_text(std::nullopt);
    int error = write_fully(*lock_, 0, std::as_bytes(std::span(own)));
    if (error == 0 && is_new) error = lock_->sync();
    if (error == 0 && is_new) error = file_system().sync_folder(path_);
    if (error == 0) return;
    if (is_new) (void)remove();
    cannot_make(path_, error);
}

BuildFolder::~BuildFolder() {
    if (lock_ && file_system().entries(path_, 2).size() == 1) (void)remove();  // only the lock: no finished phase
}

std::unique_ptr<Container> BuildFolder::finished(const std::string& phase, const Contents& wanted, std::string& why_not) const {
    ISOATLAS_CHECK(is_phase(phase));
    if (!file_exists(file(phase))) return nullptr;
    try {
        auto container = std::make_unique<Container>(file(phase));
        why_not = joined(differences(container->contents().fingerprint, wanted.fingerprint));
        if (why_not.empty()) {
            container->check_all();
            return container;
        }
    } catch (const Error& error) {  // damaged: it is recomputed
        why_not = error.text().where + ": " + error.text().what;
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
    bool gone = false;
    if (file_system().entries(path_, 2).size() == 1) {  // else the mark stays too
        (void)file_system().remove(file(kLock));        // while locked: a waiting process creates a new one
        gone = file_system().remove_folder(path_) == 0;
    }
    lock_.reset();
    return gone;
}

std::optional<BuildState> build_state(const std::string& path) {
    Obstacle obstacle;  // reported by the build
    const std::string lock = find_target(path, obstacle).path + ".build/" + kLock;
    if (!file_system().is_held(lock)) return std::nullopt;
    return state_in(text_of(lock));
}

}  // namespace isoatlas
