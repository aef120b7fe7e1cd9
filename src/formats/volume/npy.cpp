// NumPy arrays (.npy), versions 1 to 3. Format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
//
// AXIS ORDER. isoatlas counts x fastest. An array in C order (the usual one) has its LAST axis fastest, so an array of shape
// (nz, ny, nx) is a volume of size nx x ny x nz: array[z, y, x]. An array in Fortran order has its FIRST axis fastest: shape
// (nx, ny, nz) is a volume of size nx x ny x nz: array[x, y, z]. The samples are taken in the order of the file in both cases.
#include <algorithm>
#include <bit>
#include <utility>

#include "formats/common/text.h"
#include "formats/volume/formats.h"
#include "formats/volume/named_type.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::int64_t kLongestHeader = 1024 * 1024;

struct NpyHeader {
    std::string path;
    std::string type;  ///< descr without quotes: "<f4"
    bool fortran = false;
    std::vector<std::int64_t> shape;
    std::int64_t data_offset = 0;
};

[[noreturn]] void fail(const std::string& path, ErrorKind kind, const std::string& where, const std::string& what,
                       const std::string& expected, const std::string& next = "the file is damaged: write it again with numpy.save") {
    throw Error(kind, {.file = path, .where = where, .what = what, .expected = expected, .next = next});
}

/// The dictionary as text, between the fixed bytes and the samples.
std::string header_dictionary(const std::string& path, std::int64_t& data_offset) {
    const std::vector<std::byte> bytes = read_header_bytes(path, kLongestHeader);
    const auto at = [&](std::size_t i) { return std::to_integer<std::int64_t>(bytes[i]); };
    if (bytes.size() < 12) fail(path, ErrorKind::input, "offset " + std::to_string(bytes.size()), "the file ends early", "a header");
    if (at(6) < 1 || at(6) > 3) {
        fail(path, ErrorKind::unsupported, "offset 6", "version " + std::to_string(at(6)) + " of .npy is not supported", "1, 2 or 3",
             "write it again with numpy.save");
    }
    const std::int64_t length = at(6) == 1 ? at(8) + 256 * at(9) : at(8) + 256 * (at(9) + 256 * (at(10) + 256 * at(11)));
    const std::int64_t begin = at(6) == 1 ? 10 : 12;
    data_offset = begin + length;
    if (data_offset > static_cast<std::int64_t>(bytes.size())) {
        fail(path, ErrorKind::input, "offset 8", "the header claims " + std::to_string(length) + " bytes",
             "a header inside the file and below 1 MiB");
    }
    return {reinterpret_cast<const char*>(bytes.data()) + begin, static_cast<std::size_t>(length)};
}

/// What follows "'key':" in the dictionary.
std::string_view value_of(const std::string& path, std::string_view dictionary, const std::string& key) {
    for (const char quote : {'\'', '"'}) {
        const std::string name = quote + key + quote;
        const std::size_t found = dictionary.find(name);
        if (found == std::string_view::npos) continue;
        if (dictionary.find(name, found + 1) != std::string_view::npos) {
            fail(path, ErrorKind::input, "header", in_quotes(key) + " appears twice", "one value");
        }
        const std::string_view rest = trim(dictionary.substr(found + name.size()));
        if (rest.starts_with(':')) return trim(rest.substr(1));
    }
    fail(path, ErrorKind::input, "header", in_quotes(key) + " is missing", "'descr', 'fortran_order' and 'shape'");
}

std::string parse_type(const std::string& path, std::string_view value) {
    if (value.starts_with('[')) {
        fail(path, ErrorKind::unsupported, "header", "the array is structured (several values per sample)", "one number per sample",
             "save one field: numpy.save(\"field.npy\", array[\"name\"])");
    }
    const std::size_t end = value.empty() ? std::string_view::npos : value.find(value[0], 1);
    if (value.empty() || (value[0] != '\'' && value[0] != '"') || end == std::string_view::npos) {
        fail(path, ErrorKind::input, "header", "'descr' is not valid", "a type like '<f4'");
    }
    return std::string(value.substr(1, end - 1));
}

std::vector<std::int64_t> parse_shape(const std::string& path, std::string_view value) {
    const std::size_t close = value.find(')');
    std::vector<std::int64_t> shape;
    bool readable = value.starts_with('(') && close != std::string_view::npos;
    for (std::size_t begin = 1; readable && begin < close;) {
        const std::size_t end = std::min(value.find(',', begin), close);
        std::string_view word = trim(value.substr(begin, end - begin));
        if (word.ends_with('L')) word.remove_suffix(1);  // long integers of Python 2
        const std::optional<std::int64_t> size = parse_integer(word);
        readable = size.has_value() || (word.empty() && end == close);
        if (size) shape.push_back(*size);
        begin = end + 1;
    }
    if (!readable) fail(path, ErrorKind::input, "header", "'shape' is not valid", "a shape like (64, 64, 64)");
    return shape;
}

NpyHeader read_npy_header(const std::string& path) {
    NpyHeader header;
    header.path = path;
    const std::string dictionary = header_dictionary(path, header.data_offset);
    header.type = parse_type(path, value_of(path, dictionary, "descr"));
    const std::string_view order = value_of(path, dictionary, "fortran_order");
    if (!order.starts_with("True") && !order.starts_with("False")) {
        fail(path, ErrorKind::input, "header", "'fortran_order' is not valid", "True or False");
    }
    header.fortran = order.starts_with("True");
    header.shape = parse_shape(path, value_of(path, dictionary, "shape"));
    return header;
}

WideInteger set_type(const NpyHeader& header, VolumeInfo& info) {
    static constexpr NamedType kTypes[] = {{"u1", ValueType::u8},
                                           {"b1", ValueType::u8},
                                           {"i1", ValueType::i8},
                                           {"u2", ValueType::u16},
                                           {"i2", ValueType::i16},
                                           {"u4", ValueType::u32},
                                           {"i4", ValueType::i32},
                                           {"f4", ValueType::f32},
                                           {"f8", ValueType::f64},
                                           {"i8", ValueType::f64, WideInteger::int64},
                                           {"u8", ValueType::f64, WideInteger::uint64}};
    std::string name = header.type;
    char order = '=';
    if (!name.empty() && std::string_view("<>=|").find(name[0]) != std::string_view::npos) {
        order = name[0];
        name.erase(0, 1);
    }
    if (const NamedType* known = find_named_type(kTypes, name)) {
        info.type = known->type;
        if (order == '|' && size_of(info.type) > 1)
            fail(header.path, ErrorKind::input, "header", "'descr' has no byte order", "'<' or '>'");
        info.big_endian = size_of(info.type) > 1 && (order == '>' || (order == '=' && std::endian::native == std::endian::big));
        if (name == "b1") info.notes.push_back("booleans are read as 0 and 1 of type uint8");
        return known->wide;
    }
    const bool known = !name.empty() && std::string_view("fiucbOSUVMm").find(name[0]) != std::string_view::npos && name.size() > 1;
    fail(header.path, known ? ErrorKind::unsupported : ErrorKind::input, "header", in_quotes(header.type) + " samples are not supported",
         "8 to 64 bit integers, float32, float64 or bool", "convert: numpy.save(\"out.npy\", array.astype(\"float64\"))");
}

/// Sizes with the fastest axis first.
std::vector<std::int64_t> sizes_of(const NpyHeader& header) {
    std::vector<std::int64_t> sizes = header.shape;
    if (sizes.size() < 2 || sizes.size() > 4) {
        fail(header.path, ErrorKind::unsupported, "header", "the array has " + std::to_string(sizes.size()) + " axes",
             "2, 3, or 4 with time slowest", "reshape or slice it: numpy.save(\"out.npy\", array.reshape(nz, ny, nx))");
    }
    if (!header.fortran) std::reverse(sizes.begin(), sizes.end());
    return sizes;
}

}  // namespace

bool looks_like_npy(FirstBytes first, const std::string&) {
    return first.size() >= kMagic.size() && std::string_view(reinterpret_cast<const char*>(first.data()), kMagic.size()) == kMagic;
}

std::unique_ptr<VolumeReader> open_npy(const std::string& path, const OpenOptions& options) {
    const NpyHeader header = read_npy_header(path);
    VolumeInfo info;
    info.path = path;
    info.format = "NumPy";
    info.encoding = "raw";
    const WideInteger wide = set_type(header, info);
    const std::vector<std::int64_t> sizes = sizes_of(header);
    info.extent.rank = static_cast<int>(std::min<std::size_t>(3, sizes.size()));
    std::copy_n(sizes.begin(), info.extent.rank, info.extent.size.begin());
    info.notes.push_back(header.fortran ? "Fortran order: array[x, y, z]" : "C order: array[z, y, x]");
    static_cast<void>(sample_bytes(path, info.extent, info.type));  // rejects sizes below 1
    const TimeStep step = choose_time_step(path, options, sizes.size() == 4 ? sizes[3] : 1);
    std::unique_ptr<ByteSource> source = open_file_source(path, header.data_offset);
    info.file_bytes = file_size(path);
    return make_sample_reader(std::move(info), std::move(source), options, step, wide);
}

}  // namespace isoatlas
