// How the samples of an array of HDF5 lie in its file. HDF5 says where; the bytes are read, decoded and converted here, because HDF5 does
// not check that they are as many as its structures promise.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/volume/hdf5_filters.h"
#include "formats/volume/hdf5_object.h"

namespace isoatlas {

class Hdf5Storage {
public:
    /// `set` is an array whose storage was checked. memory: the type that samples are converted to. The caller holds hdf5_mutex(); nothing
    /// else here may be called with it, but the destructor must. Throws Error{input}.
    Hdf5Storage(std::shared_ptr<const Hdf5File> file, std::string path, hid_t set, hid_t memory);

    /// Whether the samples can be read here; else they are in other files, or behind filters that only HDF5 has.
    [[nodiscard]] bool is_own() const { return kind_ != Kind::library; }
    [[nodiscard]] const std::vector<std::int64_t>& dims() const { return dims_; }
    /// Along each dimension of a chunk; of an array without chunks all of its samples.
    [[nodiscard]] const std::vector<std::int64_t>& chunk() const { return chunk_; }
    [[nodiscard]] bool has_chunks() const { return kind_ == Kind::chunks; }
    /// Samples along each dimension from `first` on, the last the fastest, as `memory`. They lie inside the array. Chunks: in one of them.
    /// axes: the dimensions with more than one, at most 3, descending. Throws Error: input, resource.
    void read(std::span<const std::int64_t> first, std::span<const std::int64_t> count, std::span<std::byte> out);

private:
    enum class Kind : std::uint8_t { chunks, bytes, empty, library };
    /// Runs of samples that follow one another in steps of `step` bytes.
    struct Rows {
        std::vector<std::int64_t> first, count;
        std::vector<std::uint64_t> stride;  ///< bytes of each dimension
    };

    void open_chunks(hid_t creation);
    void open_bytes(hid_t creation, std::uint64_t bytes);
    void read_fill(hid_t creation);
    [[noreturn]] void damaged(const std::string& what, const std::string& where = "") const;
    /// Decodes the chunk of that index into value_. false: it was never written.
    [[nodiscard]] bool load(std::span<const std::int64_t> index);
    [[nodiscard]] bool find(std::span<const std::int64_t> index, Hdf5Range& place, std::uint32_t& skipped);
    void take_rows(const Rows& rows, std::span<std::byte> out);
    void fetch_row(std::uint64_t begin, std::uint64_t step, std::span<std::byte> row);
    void convert(std::span<std::byte> stored, std::span<std::byte> out);

    std::shared_ptr<const Hdf5File> file_;
    std::string path_;
    hid_t set_, memory_;
    Hdf5Handle stored_type_;
    Kind kind_ = Kind::library;
    std::vector<std::int64_t> dims_, chunk_;
    std::size_t stored_bytes_ = 0, memory_bytes_ = 0, chunk_bytes_ = 0;
    bool is_standard_ = false, swaps_ = false;  ///< is_standard: as memory, up to the order of bytes
    std::vector<Hdf5ChunkFilter> filters_;
    std::vector<std::byte> fill_;  ///< one sample, as memory
    Hdf5Range place_;              ///< of all samples; no file: in value_
    std::vector<std::int64_t> index_;
    bool is_stored_ = false;
    std::vector<std::byte> value_, scratch_, row_;
};

}  // namespace isoatlas
