#include "formats/common/vtk_arrays.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <pugixml.hpp>

#include "formats/common/byte_cursor.h"

namespace isoatlas {

namespace {

/// Deflate cannot pack better than 258 bytes in 2 bits.
constexpr std::uint64_t kMaxInflation = 1032;

enum class VtkType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
constexpr std::array kTypeNames{"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Float32", "Float64"};
constexpr std::array<std::size_t, 10> kTypeBytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

[[noreturn]] void fail(const VtkEncoding& encoding, const std::string& array, std::string what, std::string expected = {}) {
    throw Error(ErrorKind::input, {.file = encoding.file,
                                   .where = "DataArray \"" + array + "\"",
                                   .what = std::move(what),
                                   .expected = std::move(expected),
                                   .next = kDamagedFile});
}

VtkType type_named(const std::string& name, const std::string& array, const VtkEncoding& encoding) {
    const auto found = std::find(kTypeNames.begin(), kTypeNames.end(), name);
    if (found != kTypeNames.end()) return static_cast<VtkType>(found - kTypeNames.begin());
    throw Error(ErrorKind::unsupported, {.file = encoding.file,
                                         .where = "DataArray \"" + array + "\"",
                                         .what = "type " + in_quotes(name) + " is not numeric",
                                         .next = "write the file again with VTK or ParaView"});
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// The first `count` bytes of a base64 text (all when it is shorter); `used`: characters that encode them, including padding.
std::string base64_prefix(std::string_view text, std::size_t count, std::size_t& used, const std::string& file) {
    std::string out;
    out.reserve(std::min(count, text.size() / 4 * 3 + 3));
    std::uint32_t bits = 0;
    int digits = 0;
    bool padded = false;
    for (used = 0; used < text.size(); ++used) {
        const char c = text[used];
        if (ByteCursor::is_space(c)) continue;
        if (digits == 0 && (out.size() >= count || padded)) break;
        if (c == '=') {
            padded = true;
        } else if (const int digit = base64_digit(c); digit >= 0 && !padded) {
            bits = bits << 6 | static_cast<std::uint32_t>(digit);
            if (digits > 0) out.push_back(static_cast<char>(bits >> (6 - 2 * digits) & 0xff));
        } else {
            break;  // '<' ends appended data
        }
        digits = (digits + 1) % 4;
    }
    if (digits != 0) throw Error(ErrorKind::input, {.file = file, .what = "base64 data is cut off or corrupt", .next = kDamagedFile});
    out.resize(std::min(out.size(), count));
    return out;
}

std::uint64_t header_number(std::string_view bytes, std::size_t index, const VtkEncoding& encoding) {
    ByteCursor in(bytes, encoding.file);
    in.go_to(index * encoding.header_bytes);
    if (encoding.header_bytes == 8) return in.number<std::uint64_t>(encoding.big_endian, "a block header");
    return in.number<std::uint32_t>(encoding.big_endian, "a block header");
}

std::string inflate_block(std::string_view packed, std::uint64_t expected, const std::string& array, const VtkEncoding& encoding) {
    if (expected > kMaxInflation * (packed.size() + 1)) fail(encoding, array, "a compressed block claims more bytes than it can hold");
    std::string plain(static_cast<std::size_t>(expected), '\0');
    auto size = static_cast<uLongf>(expected);
    const int code = ::uncompress(reinterpret_cast<Bytef*>(plain.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                                  static_cast<uLong>(packed.size()));
    if (code != Z_OK || size != expected) fail(encoding, array, "a compressed block is corrupt");
    return plain;
}

/// Header of compressed data: number of blocks, size of a block, size of a short last block (0: none), packed size of each.
/// `header` holds exactly the header, `packed` what follows.
std::string inflate_blocks(std::string_view header, std::string_view packed, const std::string& array, const VtkEncoding& encoding) {
    const std::uint64_t blocks = header_number(header, 0, encoding);
    const std::uint64_t full = header_number(header, 1, encoding), last = header_number(header, 2, encoding);
    std::string plain;
    for (std::uint64_t i = 0; i < blocks; ++i) {
        const std::uint64_t size = header_number(header, 3 + i, encoding);
        if (size > packed.size()) fail(encoding, array, "the compressed data is cut off");
        plain += inflate_block(packed.substr(0, size), i + 1 == blocks && last > 0 ? last : full, array, encoding);
        if (static_cast<std::int64_t>(plain.size()) / 8 > encoding.budget) fail(encoding, array, "holds more data than the file can");
        packed.remove_prefix(size);
    }
    return plain;
}

std::uint64_t header_size(std::uint64_t blocks, std::size_t bytes_left, const std::string& array, const VtkEncoding& encoding) {
    if (blocks > bytes_left / encoding.header_bytes) fail(encoding, array, "claims more compressed blocks than the file holds");
    return encoding.header_bytes * (3 + blocks);
}

std::string decode_base64_array(std::string_view text, const std::string& array, const VtkEncoding& encoding) {
    std::size_t used = 0;
    const std::uint64_t first = header_number(base64_prefix(text, encoding.header_bytes, used, encoding.file), 0, encoding);
    if (encoding.zlib) {
        if (first == 0) return {};
        const std::uint64_t size = header_size(first, text.size(), array, encoding);
        const std::string header = base64_prefix(text, size, used, encoding.file);
        if (header.size() < size) fail(encoding, array, "the data is cut off");
        std::uint64_t packed = 0;
        for (std::uint64_t i = 0; i < first; ++i) {
            packed += std::min<std::uint64_t>(header_number(header, 3 + i, encoding), text.size());
        }
        const std::string_view rest = text.substr(used);
        return inflate_blocks(header, base64_prefix(rest, packed, used, encoding.file), array, encoding);
    }
    if (first > text.size()) fail(encoding, array, "claims " + std::to_string(first) + " bytes, more than the file holds");
    std::string bytes = base64_prefix(text, encoding.header_bytes + first, used, encoding.file);
    if (bytes.size() != encoding.header_bytes + first) fail(encoding, array, "the data is cut off");
    return bytes.substr(encoding.header_bytes);
}

std::string decode_raw_array(std::string_view data, const std::string& array, const VtkEncoding& encoding) {
    if (data.size() < encoding.header_bytes) fail(encoding, array, "the appended data is cut off");
    const std::uint64_t first = header_number(data, 0, encoding);
    if (encoding.zlib) {
        if (first == 0) return {};
        const std::uint64_t size = header_size(first, data.size(), array, encoding);
        if (size > data.size()) fail(encoding, array, "the appended data is cut off");
        return inflate_blocks(data.substr(0, size), data.substr(size), array, encoding);
    }
    if (first > data.size() - encoding.header_bytes) {
        fail(encoding, array, "claims " + std::to_string(first) + " bytes",
             std::to_string(data.size() - encoding.header_bytes) + " at most");
    }
    return std::string(data.substr(encoding.header_bytes, first));
}

template <class T>
void convert(std::string_view bytes, bool big_endian, std::vector<T>& out, VtkType type, const std::string& file) {
    ByteCursor in(bytes, file);
    const std::size_t count = bytes.size() / kTypeBytes[static_cast<std::size_t>(type)];
    out.reserve(count);
    const auto next = [&]() -> T {
        switch (type) {
            case VtkType::i8: return static_cast<T>(in.number<std::int8_t>(big_endian, "an array"));
            case VtkType::u8: return static_cast<T>(in.number<std::uint8_t>(big_endian, "an array"));
            case VtkType::i16: return static_cast<T>(in.number<std::int16_t>(big_endian, "an array"));
            case VtkType::u16: return static_cast<T>(in.number<std::uint16_t>(big_endian, "an array"));
            case VtkType::i32: return static_cast<T>(in.number<std::int32_t>(big_endian, "an array"));
            case VtkType::u32: return static_cast<T>(in.number<std::uint32_t>(big_endian, "an array"));
            case VtkType::i64: return static_cast<T>(in.number<std::int64_t>(big_endian, "an array"));
            case VtkType::u64: return static_cast<T>(static_cast<std::int64_t>(in.number<std::uint64_t>(big_endian, "an array")));
            case VtkType::f32:
                if constexpr (std::is_floating_point_v<T>) return static_cast<T>(in.number<float>(big_endian, "an array"));
                break;
            case VtkType::f64:
                if constexpr (std::is_floating_point_v<T>) return in.number<double>(big_endian, "an array");
                break;
        }
        return T{};
    };
    for (std::size_t i = 0; i < count; ++i) out.push_back(next());
}

template <class T>
void parse_ascii(std::string_view text, std::vector<T>& out, const std::string& array, const VtkEncoding& encoding) {
    ByteCursor in(text, encoding.file);
    for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
        T value;
        if (!parse_number(word, value)) fail(encoding, array, in_quotes(word) + " is not a number of this array's type");
        out.push_back(value);
    }
}

std::string decode_binary(const pugi::xml_node& element, std::string_view format, const std::string& array, const VtkEncoding& encoding) {
    if (format == "binary") return decode_base64_array(element.text().get(), array, encoding);
    if (format != "appended") fail(encoding, array, "unknown format " + in_quotes(format), "ascii, binary or appended");
    std::uint64_t offset = 0;
    const std::string_view text = element.attribute("offset").value();
    if (!parse_number(text, offset) || offset > encoding.appended.size())
        fail(encoding, array, "the offset " + in_quotes(text) + " is not in the file");
    const std::string_view data = encoding.appended.substr(offset);
    return encoding.appended_base64 ? decode_base64_array(data, array, encoding) : decode_raw_array(data, array, encoding);
}

}  // namespace

VtkValues read_vtk_array(const pugi::xml_node& element, VtkEncoding& encoding) {
    const std::string array = element.attribute("Name").as_string("(unnamed)");
    const VtkType type = type_named(element.attribute("type").value(), array, encoding);
    const std::string_view format = element.attribute("format").as_string("ascii");
    VtkValues values;
    values.is_real = type >= VtkType::f32;
    if (format == "ascii") {
        if (values.is_real) {
            parse_ascii(element.text().get(), values.reals, array, encoding);
        } else {
            parse_ascii(element.text().get(), values.integers, array, encoding);
        }
    } else {
        const std::string bytes = decode_binary(element, format, array, encoding);
        if (bytes.size() % kTypeBytes[static_cast<std::size_t>(type)] != 0) fail(encoding, array, "holds a broken number of bytes");
        if (values.is_real) {
            convert(bytes, encoding.big_endian, values.reals, type, encoding.file);
        } else {
            convert(bytes, encoding.big_endian, values.integers, type, encoding.file);
        }
    }
    encoding.budget -= static_cast<std::int64_t>(values.size());
    if (encoding.budget < 0) fail(encoding, array, "the arrays hold more data than the file can");
    return values;
}

}  // namespace isoatlas
