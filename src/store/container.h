// Reads a store: header, contents, and arrays by their offsets. All data are verified by checksums before they are returned.
//
// The header is the first 512 bytes: "isoatlas store\n", a zero byte, then little endian 64-bit numbers: the size of the file, offset,
// length and checksum of the contents, and the checksum of all these 48 bytes; zeros fill the rest.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codec/frame.h"
#include "formats/common/file_access.h"
#include "isoatlas/units.h"
#include "store/contents.h"

namespace isoatlas {

inline constexpr std::int64_t kHeaderBytes = 512;
inline constexpr char kMagic[16] = "isoatlas store\n";  // and a zero byte

struct Header {
    std::int64_t file_size = 0, contents_offset = 0, contents_bytes = 0;
    std::uint64_t contents_checksum = 0;
};
[[nodiscard]] std::array<std::byte, kHeaderBytes> bytes_of_header(const Header& header);
/// Ranges with checksums of their own: header, contents, arrays and their block tables; without the chunks of arrays.
[[nodiscard]] std::vector<ByteRange> checked_ranges(const std::vector<StoredArray>& arrays, const Header& header);
/// Is a file a store, possibly damaged? `first`: its first kBeginning bytes, or all of a shorter file. Most of the magic number, or HDF5's
/// at its position in a store, is sufficient: checksums find further damage.
inline constexpr std::size_t kBeginning = kHeaderBytes + 8;
[[nodiscard]] bool begins_like_a_store(std::span<const std::byte> first);

/// An open store. Reading is thread safe.
class Container {
public:
    /// Reads header and contents. Throws Error: input (missing, not a store, incomplete, damaged), unsupported (a later version).
    /// All arrays, as in the file. corrections: of contents().volume, in memory.
    explicit Container(const std::string& path, const Corrections& corrections = {});
    /// Those of one polarity, as those of a store of it alone (contents_of()); none: low where it holds low values alone, else high. Throws
    /// as above, unsupported when it does not hold the polarity.
    Container(const std::string& path, std::optional<Polarity> polarity, const Corrections& corrections = {});

    [[nodiscard]] const Header& header() const { return header_; }
    [[nodiscard]] const Contents& contents() const { return contents_; }
    /// Version of the format. Values of elements that are recomputed from the samples follow the rules of this version.
    [[nodiscard]] int version() const { return contents_.version; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Were the steps of the grid corrected? Then stored physical sizes are not those of contents().volume.
    [[nodiscard]] bool has_other_steps() const { return has_other_steps_; }
    [[nodiscard]] std::int64_t file_size() const { return file_size_; }

    /// Bytes [first, first + out.size()) of an array whose blocks have checksums. Cost: reads whole blocks.
    void read(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const;
    /// Bytes of an array with checksums per part; the caller verifies them.
    void read_unchecked(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const;

    /// Non-blocking read_unchecked(); false: the bytes are not in memory.
    [[nodiscard]] bool read_if_present(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const;
    /// Pages of the file need not stay in memory.
    void drop_pages() const { file_->drop_pages(); }
    /// Prefetches ranges of bytes of an array, ascending.
    void prefetch(const StoredArray& array, std::vector<FileRange> ranges) const;
    /// Of a store on another machine: fetches whole arrays with their checksums, together, before they are read. Two round trips, or one
    /// where no array is in chunks.
    void fetch(std::span<const StoredArray* const> arrays) const;
    /// The same for ranges of bytes of an array, ascending; of one that is not in chunks nothing.
    void fetch(const StoredArray& array, std::span<const FileRange> bytes) const;
    /// The same for all arrays of groups ("objects" for "objects/id", ...); groups that the store does not have are ignored.
    void fetch_groups(std::span<const std::string_view> groups) const;

    /// The JSON text of the contents in the file.
    [[nodiscard]] std::string contents_text() const;
    /// The verified block table of an array: a checksum each, or the three numbers of a StoredChunk.
    [[nodiscard]] std::vector<std::uint64_t> index_of(const StoredArray& array) const;

    /// All numbers of an array.
    template <class T>
    [[nodiscard]] std::vector<T> all(std::string_view name, std::string_view type) const {
        const StoredArray& array = contents_.array(name, type);
        std::vector<T> numbers(static_cast<std::size_t>(array.count()));
        read(array, 0, std::as_writable_bytes(std::span<T>(numbers)));
        return numbers;
    }

    /// The verified compressed chunks of an array, in order.
    void for_each_chunk(const StoredArray& array, const std::function<void(std::span<const std::byte>)>& use) const;

    /// Reads every array with checksums, and checks that every byte of the file is covered by one (from version 3 on); throws Error{input}
    /// for the first damage.
    void check_all() const;

private:
    void read_header();
    /// Verifies the frame before anything is parsed. Returns whether there is one.
    bool check_frame();
    void check_nothing_is_left_out() const;
    void check_inside(const StoredArray& array, std::int64_t first, std::size_t bytes) const;
    [[nodiscard]] std::vector<std::uint64_t> checksums_of(const StoredArray& array, std::int64_t first, std::int64_t last) const;
    [[nodiscard]] std::vector<StoredChunk> chunk_table(const StoredArray& array, std::int64_t first, std::int64_t last) const;
    [[nodiscard]] std::vector<StoredChunk> chunks_of(const StoredArray& array, std::int64_t first, std::int64_t last) const;
    [[nodiscard]] std::vector<std::byte> read_chunk(const StoredArray& array, std::int64_t number, const StoredChunk& chunk) const;
    void read_chunks(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const;
    [[noreturn]] void damaged(const std::string& where, const std::string& what) const;
    void fetch(std::vector<FileRange> ranges) const;

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t file_size_ = 0;
    Header header_;
    StoreFrame frame_;  ///< empty before version 3
    Contents contents_;
    std::vector<StoredArray> all_arrays_;  ///< of the file
    bool has_other_steps_ = false;
};

}  // namespace isoatlas
