#include "base/scratch_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "base/budget_poll.h"
#include "base/pages.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

[[noreturn]] void scratch_failed(const std::string& folder, int error) {
    throw Error(ErrorKind::resource, {.file = folder,
                                      .what = std::string("the scratch file cannot grow: ") + std::strerror(error),
                                      .next = "free some disk space, build the store on another disk, or allow more memory",
                                      .reason = Reason::no_scratch_space});
}

/// An unnamed file in a folder.
int open_scratch(const std::string& folder) {
    int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0) return file;
    std::string name = folder + "/.isoatlas-scratch-XXXXXX";  // file systems without unnamed files
    file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file < 0) scratch_failed(folder, errno);
    ::unlink(name.c_str());
    return file;
}

/// Maps a part of the file, at an address that has another place in its huge page than the part has in the file: the system would map
/// up to 2 MB of its cache at one touch, and so maps BudgetPoll::kTouch. Null when it cannot.
void* map_scratch(int file, off_t offset, std::size_t size) {
    void* const room = ::mmap(nullptr, size + kHugePage, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return nullptr;
    const auto begin = reinterpret_cast<std::uintptr_t>(room);
    const std::size_t head = (static_cast<std::size_t>(offset) + BudgetPoll::kTouch - begin) % kHugePage;  // wraps around and back
    char* const at = static_cast<char*>(room) + head;
    if (head > 0) ::munmap(room, head);
    if (head < kHugePage) ::munmap(at + size, kHugePage - head);
    if (::mmap(at, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file, offset) != MAP_FAILED) return at;
    const int error = errno;
    ::munmap(at, size);
    errno = error;
    return nullptr;
}

}  // namespace

ScratchFile::~ScratchFile() {
    if (file_ >= 0) ::close(file_);
}

void ScratchFile::fail(int error) const { scratch_failed(folder_, error); }

ScratchFile::Room ScratchFile::take(std::size_t bytes) {
    const std::size_t size = rounded_up(bytes, kPage);
    if (file_ < 0) file_ = open_scratch(folder_);
    const std::optional<off_t> unused = reuse(size);
    const off_t offset = unused ? *unused : static_cast<off_t>(std::exchange(end_, end_ + size));
    ++calls_;
    return {file_, {offset, size}, !unused};
}

ScratchFile::Mapped ScratchFile::map(const Room& room) {
    // Blocks are reserved now: a full disk is an error here, and not a signal when a page is written.
    const int error = room.is_new ? ::posix_fallocate(room.file, room.part.offset, static_cast<off_t>(room.part.size)) : 0;
    if (error != 0) return {nullptr, error};
    void* const memory = map_scratch(room.file, room.part.offset, room.part.size);
    return {memory, memory == nullptr ? errno : 0};
}

void ScratchFile::add(void* memory, const Part& part) {
    --calls_;
    arrays_.emplace(static_cast<char*>(memory), part);
    mapped_ += part.size;
}

void ScratchFile::drop() { --calls_; }

std::optional<ScratchFile::Part> ScratchFile::remove(void* memory) {
    const auto found = arrays_.find(static_cast<char*>(memory));
    if (found == arrays_.end()) return std::nullopt;
    const Part part = found->second;
    arrays_.erase(found);
    mapped_ -= part.size;
    ++calls_;
    return part;
}

void ScratchFile::give(const Part& part) {
    --calls_;
    add_unused(part);
}

std::optional<ScratchFile::Place> ScratchFile::find(const void* memory) const {
    const auto* const at = static_cast<const char*>(memory);
    auto array = arrays_.upper_bound(const_cast<char*>(at));
    if (array == arrays_.begin()) return std::nullopt;
    --array;
    const auto into = static_cast<std::size_t>(at - array->first);
    if (into >= array->second.size) return std::nullopt;
    return Place{file_, array->second.offset + static_cast<off_t>(into)};
}

bool ScratchFile::unmap_next(std::size_t bytes) {
    while (rounds_ < 2) {  // to the end, and from the beginning again
        auto array = arrays_.upper_bound(next_unmapped_);
        if (array != arrays_.begin()) --array;
        for (; array != arrays_.end(); ++array) {
            const auto& [memory, part] = *array;
            const std::size_t from = next_unmapped_ > memory ? static_cast<std::size_t>(next_unmapped_ - memory) : 0;
            if (from >= part.size) continue;
            const std::size_t size = std::min(bytes, part.size - from);
            ::madvise(memory + from, size, MADV_DONTNEED);
            next_unmapped_ = memory + from + size;
            return true;
        }
        next_unmapped_ = nullptr;
        ++rounds_;
    }
    return false;
}

/// The smallest unused part of the file that is large enough: its pages are in memory already, or its blocks on the disk.
std::optional<off_t> ScratchFile::reuse(std::size_t size) {
    auto best = unused_.end();
    for (auto part = unused_.begin(); part != unused_.end(); ++part) {
        if (part->second >= size && (best == unused_.end() || part->second < best->second)) best = part;
    }
    if (best == unused_.end()) return std::nullopt;
    const auto [offset, all] = *best;
    unused_.erase(best);
    if (all > size) unused_.emplace(offset + static_cast<off_t>(size), all - size);
    return offset;
}

void ScratchFile::add_unused(const Part& added) {
    auto part = unused_.emplace(added.offset, added.size).first;
    const auto next = std::next(part);
    if (next != unused_.end() && part->first + static_cast<off_t>(part->second) == next->first) {
        part->second += next->second;
        unused_.erase(next);
    }
    if (part == unused_.begin()) return;
    const auto before = std::prev(part);
    if (before->first + static_cast<off_t>(before->second) != part->first) return;
    before->second += part->second;
    unused_.erase(part);
}

}  // namespace isoatlas
