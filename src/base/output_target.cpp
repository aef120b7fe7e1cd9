#include "base/output_target.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/temporary_name.h"
#include "isoatlas/error.h"
#include "isoatlas/output_file.h"

namespace isoatlas {
namespace {

using Kind = FileStatus::Kind;
constexpr int kMaxLinks = 40;  // as many as the system follows
constexpr const char* kOtherName = "choose another name";

bool is_own_descriptor(const std::string& path) { return path == "/dev/stdout" || path.starts_with("/dev/fd/"); }

Obstacle refused_by_system(int error) {
    return {"cannot be written: " + std::system_category().message(-error), next_step_after(error), reason_after(error)};
}

std::string octal(unsigned mode) {
    std::string digits;
    for (int shift = 9; shift >= 0; shift -= 3) digits += static_cast<char>('0' + (mode >> static_cast<unsigned>(shift) & 7U));
    return digits;
}

/// Of the file where the links end.
Obstacle obstacle_at(const OutputTarget& target, bool behind_link) {
    const FileStatus& status = target.status;
    const std::string place = behind_link ? "is a link to " + target.path + ", which " : "";
    if (status.kind == Kind::missing && status.error != -ENOENT) return refused_by_system(status.error);
    if (status.kind == Kind::missing && behind_link) return {place + "is not there", "remove the link, or name the file itself"};
    if (status.kind == Kind::folder)
        return {place + "cannot be written: is a directory", next_step_after(-EISDIR), Reason::output_is_folder};
    if (status.kind == Kind::other)
        return {place + "is not a regular file but a device, a pipe or a socket", kOtherName, Reason::output_refused};
    if (status.kind == Kind::regular && behind_link && !status.own)
        return {place + "belongs to another user", kOtherName, Reason::output_refused};
    if (status.kind == Kind::regular && !status.writable)
        return {place + "is there and may not be written to (permissions " + octal(status.mode) + ")",
                "choose another name, or allow writing to it", Reason::output_read_only};
    return {};
}

Obstacle obstacle_of_folder(const std::string& path) {
    const FileStatus folder = file_system().status(folder_of(path));
    if (folder.kind == Kind::missing) return refused_by_system(folder.error);
    if (folder.kind != Kind::folder) return refused_by_system(-ENOTDIR);
    if (!folder.writable) return {"lies in a folder that may not be written to", next_step_after(-EACCES), Reason::not_permitted};
    return {};
}

}  // namespace

std::string next_step_after(int error) {
    switch (-error) {
        case ENOSPC:
        case EDQUOT: return "free some space or write to another disk";
        case EFBIG: return "write to a file system (or under a limit) that takes files of this size";
        case ENOENT: return "create the folder first, or check its name";
        case EACCES:
        case EPERM: return "choose a folder you may write to, or change its permissions";
        case EROFS: return "choose a folder on a disk that is not read-only";
        case EISDIR: return "give the name of a file, not of a folder";
        case EWOULDBLOCK: return "wait until the other program has finished, or choose another name";
        case ENAMETOOLONG: return "choose a shorter name";
        case ELOOP: return "remove the links, which go in circles, or choose another name";
        default: return "check the disk and the folder, then try again";
    }
}

Reason reason_after(int error) {
    switch (-error) {
        case ENOSPC:
        case EDQUOT: return Reason::disk_full;
        case EFBIG: return Reason::file_too_large;
        case ENOENT: return Reason::folder_missing;
        case EACCES:
        case EPERM: return Reason::not_permitted;
        case EROFS: return Reason::disk_read_only;
        case EISDIR: return Reason::output_is_folder;
        default: return Reason::none;
    }
}

OutputTarget find_target(const std::string& path, Obstacle& obstacle) {
    OutputTarget target{path, {}, is_own_descriptor(path)};
    if (target.is_stream) return target;
    for (int links = 0;; ++links) {
        target.status = file_system().status_of_name(target.path);
        if (target.status.kind != Kind::link) {
            obstacle = obstacle_at(target, links > 0);
            break;
        }
        if (!target.status.trusted) obstacle = {"is a link that another user made", kOtherName, Reason::output_refused};
        if (links == kMaxLinks) obstacle = refused_by_system(-ELOOP);
        if (!obstacle.what.empty()) return target;
        const std::filesystem::path link = file_system().link(target.path);
        target.path = link.is_absolute() ? link.string() : (std::filesystem::path(target.path).parent_path() / link).string();
    }
    if (obstacle.what.empty()) obstacle = obstacle_of_folder(target.path);
    return target;
}

OutputTarget require_target(const std::string& path) {
    Obstacle obstacle;
    OutputTarget target = find_target(path, obstacle);
    if (!obstacle.what.empty())
        throw Error(ErrorKind::resource, {.file = path, .what = obstacle.what, .next = obstacle.next, .reason = obstacle.reason});
    return target;
}

std::string output_target(const std::string& path) { return require_target(path).path; }

void check_output_file(const std::string& path) { (void)require_target(path); }

}  // namespace isoatlas
