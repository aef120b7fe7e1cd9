// An HDF5 file to read: its groups, attributes and arrays. Nothing is trusted: every size is bounded before memory is taken, and files that
// links lead to are opened only in the folder of the file, unless links may be followed.
//
// Paths of objects begin with "/". All functions take the lock of HDF5 and throw Error{input} where the file is damaged.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/wide_integers.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Numbers of an array, as the file has them.
struct Hdf5Type {
    std::string name{};                ///< "uint16", "float16", "int64", "compound", "text", ...
    std::optional<ValueType> value{};  ///< as which they are read; none: they are not
    bool is_number = false;
    bool big_endian = false;
    bool is_half = false;  ///< 16-bit floating point of IEEE 754
    WideInteger wide = WideInteger::none;
};

struct Hdf5Array {
    std::string path{};
    std::vector<std::int64_t> dims{};  ///< the slowest first; empty: one number
    Hdf5Type type{};
    std::vector<std::int64_t> chunk{};  ///< empty: not in chunks
    std::string encoding{};             ///< "raw", "gzip", ...
};

class Hdf5File {
public:
    /// Throws Error{input} when HDF5 cannot open the file.
    Hdf5File(const std::string& path, bool follow_links);
    ~Hdf5File();
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;

    enum class Kind : std::uint8_t { none, group, array, other };
    /// none: nothing is there, or a link leads nowhere. refused: set to the error of a link that may not be followed.
    [[nodiscard]] Kind kind(const std::string& object, std::optional<Error>* refused = nullptr) const;
    [[nodiscard]] bool has(const std::string& object) const { return kind(object) != Kind::none; }
    /// A text that two paths share exactly when they lead to one object; empty: none is there.
    [[nodiscard]] std::string identity(const std::string& object) const;
    /// Of the members of a group in the order of their bytes, at most kMostNames. Empty: no such group.
    [[nodiscard]] std::vector<std::string> names(const std::string& group) const;
    static constexpr std::size_t kMostNames = 100'000;

    /// Throws Error{input} when there is none.
    [[nodiscard]] Hdf5Array array(const std::string& path) const;
    /// All numbers of an array of at most two dimensions. Throws Error: input, unsupported (no numbers, more than kMostNumbers, a filter).
    [[nodiscard]] std::vector<double> line(const std::string& path) const;
    static constexpr std::int64_t kMostNumbers = std::int64_t{1} << 22;
    /// Arrays that an attribute or an array of references to objects names: their identities, "" for what is no reference; likewise of
    /// lists.
    [[nodiscard]] std::vector<std::vector<std::string>> references(const std::string& object, const std::string& attribute) const;

    [[nodiscard]] bool has_attribute(const std::string& object, const std::string& attribute) const;
    /// Texts of an attribute, without what fills them up; empty: there is none, or it is no text.
    [[nodiscard]] std::vector<std::string> texts(const std::string& object, const std::string& attribute) const;
    /// All of them as one: files of Imaris have a text for each character. "": none.
    [[nodiscard]] std::string text(const std::string& object, const std::string& attribute) const;
    /// Numbers of an attribute; empty: there is none, they are no numbers or more than 65,536.
    [[nodiscard]] std::vector<double> numbers(const std::string& object, const std::string& attribute) const;
    /// The bits of the same as integers of 64 bits.
    [[nodiscard]] std::vector<std::uint64_t> integers(const std::string& object, const std::string& attribute, WideInteger type) const;

    [[nodiscard]] const std::string& path() const;
    struct Data;
    [[nodiscard]] Data& data() const { return *data_; }

private:
    std::unique_ptr<Data> data_;
};

/// "/a" + "b" = "/a/b".
[[nodiscard]] std::string join_path(const std::string& group, const std::string& name);

/// Which samples of an array are the volume.
struct Hdf5Place {
    std::array<int, 3> dimension{-1, -1, -1};  ///< of the array, for x, y, z, descending; -1: none
    std::vector<std::int64_t> index{};         ///< along all dimensions; of those of the volume that of its first sample
    std::array<bool, 3> flipped{};             ///< axes whose samples come in reverse order
    WideIntegers wide{};                       ///< how integers of 64 bits are read
};
/// The last dimensions of an array as x, y and z; all others at index 0. Sets also extent, type, byte order, encoding and chunk of info,
/// with a note about integers of 64 bits.
[[nodiscard]] Hdf5Place place_volume(const Hdf5Array& array, int rank, VolumeInfo& info);

/// Reads info.extent samples of info.type. Throws Error: input (damaged), unsupported (a filter that HDF5 has not; no ValueType).
[[nodiscard]] std::unique_ptr<VolumeReader> make_hdf5_reader(VolumeInfo info, std::shared_ptr<const Hdf5File> file, const Hdf5Array& array,
                                                             const Hdf5Place& place);

}  // namespace isoatlas
