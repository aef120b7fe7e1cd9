// ScratchFile: the unnamed file of one memory budget, and which part of it is whose array. Not thread safe, except for mapping.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace isoatlas {

class ScratchFile {
public:
    /// Made in the folder when the first array needs it.
    explicit ScratchFile(std::string folder) : folder_(std::move(folder)) {}
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    struct Part {
        off_t offset;
        std::size_t size;
    };
    /// A part for a new array: of a part that is unused, or at the end of the file. Then add() or drop() follows. Throws Error{resource}.
    struct Room {
        int file;
        Part part;
        bool is_new;  ///< its blocks are not on the disk yet
    };
    [[nodiscard]] Room take(std::size_t bytes);
    /// Reserves the blocks and maps the part; null: error says why. May be called by several threads.
    struct Mapped {
        void* memory;
        int error;
    };
    [[nodiscard]] static Mapped map(const Room& room);
    void add(void* memory, const Part& part);
    void drop();

    /// The array at this address is being unmapped; give() follows. Empty: it does not lie here.
    [[nodiscard]] std::optional<Part> remove(void* memory);
    void give(const Part& part);

    /// Where an address inside of an array lies. Empty: not here.
    struct Place {
        int file;
        off_t offset;
    };
    [[nodiscard]] std::optional<Place> find(const void* memory) const;

    /// Unmaps the next part of the arrays, at most so many bytes, in turn. False: all of them were visited since begin_unmapping().
    bool unmap_next(std::size_t bytes);
    void begin_unmapping() { rounds_ = 0; }

    [[nodiscard]] bool is_unused() const { return arrays_.empty() && calls_ == 0; }
    /// Of all arrays.
    [[nodiscard]] std::size_t mapped() const { return mapped_; }
    [[noreturn]] void fail(int error) const;

private:
    [[nodiscard]] std::optional<off_t> reuse(std::size_t size);
    void add_unused(const Part& part);

    const std::string folder_;
    int file_ = -1;
    int calls_ = 0;  // that use the file right now
    std::size_t end_ = 0, mapped_ = 0;
    std::map<char*, Part> arrays_;
    char* next_unmapped_ = nullptr;
    int rounds_ = 0;
    std::map<off_t, std::size_t> unused_;  // parts of the file, from offset to size; no two are neighbours
};

}  // namespace isoatlas
