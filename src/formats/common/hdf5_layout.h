// Layout of an HDF5 file: positions of its arrays, and the bytes of HDF5's own structures. Writes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isoatlas {

/// Names are paths from the root ("/PointData/Normals"); groups above an array are made with it. No time stamps, so that the same arrays
/// give the same bytes. Memory: HDF5's metadata of every array, not the arrays. Throws Error{resource} when HDF5 has no memory for that.
class Hdf5Layout {
public:
    /// path: for messages. user_block: bytes before HDF5's own (0, 512, 1024, ...).
    Hdf5Layout(std::string path, std::int64_t user_block);
    ~Hdf5Layout();
    Hdf5Layout(const Hdf5Layout&) = delete;
    Hdf5Layout& operator=(const Hdf5Layout&) = delete;

    /// Allocates an array, with its groups. Returns the offset of its first byte; 0 when it has none.
    [[nodiscard]] std::int64_t add(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape);
    /// The same for an array that is compressed chunk by chunk (shuffle, deflate): chunks follow by add_chunk(), the last dimension
    /// fastest, before anything else. level: of deflate, which its readers do not need to know.
    void begin_chunks(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape,
                      const std::vector<std::int64_t>& chunk, int level);
    /// Allocates the next chunk. Returns its offset.
    [[nodiscard]] std::int64_t add_chunk(std::int64_t bytes);

    /// An array of rows without a bound, not compressed: shape {rows}, or {rows, columns} for more than one. Its number is for add_rows().
    [[nodiscard]] std::size_t begin_rows(const std::string& name, const std::string& type, std::int64_t columns, std::int64_t chunk_rows);
    /// Allocates the next chunk of it, always a whole one, with so many rows; only the last may have less than chunk_rows. Returns its
    /// offset.
    [[nodiscard]] std::int64_t add_rows(std::size_t array, std::int64_t rows);

    /// A list of texts, of which HDF5 keeps the bytes too.
    void add_texts(const std::string& name, std::span<const std::string> texts);
    /// An array that is there, or a group, which may be there, and an attribute of it: one number, several, or a text of at least one byte.
    void set_attribute(const std::string& object, const char* name, std::span<const std::int64_t> numbers);
    void set_attribute(const std::string& object, const char* name, std::span<const double> numbers);
    void set_attribute(const std::string& object, const char* name, std::string_view text);
    /// A list of texts of one character each.
    void set_letters(const std::string& object, const char* name, std::string_view letters);

    /// Bytes of the file so far; after finish() those of the whole file.
    [[nodiscard]] std::int64_t size() const;

    struct Piece {
        std::int64_t offset;
        std::vector<std::byte> bytes;
    };
    /// HDF5's structures, to be written in this order (later pieces replace earlier ones). No array can be added afterwards.
    [[nodiscard]] const std::vector<Piece>& finish();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
