// Layout of an HDF5 file: positions of its arrays, and the bytes of HDF5's own structures. Writes nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace isoatlas {

/// Contiguous allocated arrays after a user block of kHeaderBytes; no time stamps, so that the same arrays give the same bytes. Memory:
/// HDF5's metadata of every array, not the arrays. Throws Error{resource} when HDF5 has no memory for that.
class Hdf5Layout {
public:
    /// path: for messages.
    explicit Hdf5Layout(std::string path);
    ~Hdf5Layout();
    Hdf5Layout(const Hdf5Layout&) = delete;
    Hdf5Layout& operator=(const Hdf5Layout&) = delete;

    /// Allocates an array, with its groups. Returns the offset of its first byte; 0 when it has none.
    [[nodiscard]] std::int64_t add(const std::string& name, const std::string& type, const std::vector<std::int64_t>& shape);
    /// The same for an array of one dimension that is compressed chunk by chunk: chunks follow by add_chunk(), before anything else.
    void begin_chunks(const std::string& name, const std::string& type, std::int64_t count, std::int64_t chunk);
    /// Allocates the next chunk. Returns its offset.
    [[nodiscard]] std::int64_t add_chunk(std::int64_t bytes);
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
