#include "formats/common/vtk_array.h"

#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <vector>

#include "formats/common/base64_source.h"
#include "formats/common/block_inflater.h"
#include "formats/common/byte_cursor.h"
#include "formats/common/text.h"
#include "formats/common/text_source.h"

namespace isoatlas {

namespace {

[[noreturn]] void bad_array(const VtkFile& file, const VtkArray& array, const std::string& what, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = file.path,
                                   .where = "array " + in_quotes(array.name),
                                   .what = what,
                                   .expected = expected,
                                   .next = "the file is truncated or damaged: get it again"});
}

void require_budget(const VtkFile& file, const VtkArray& array, std::int64_t budget) {
    if (budget < 0) bad_array(file, array, "the arrays up to it have more values than the file can hold", "arrays that do not overlap");
}

bool is_swapped(const VtkFile& file) { return file.big_endian != (std::endian::native == std::endian::big); }

/// Words of an array header: lengths, UInt32 or UInt64.
std::int64_t read_word(ByteSource& source, const VtkFile& file, const VtkArray& array) {
    std::array<std::byte, 8> raw{};
    const std::size_t size = file.wide_headers ? 8 : 4;
    const std::span<std::byte> bytes = std::span(raw).first(size);
    source.read(bytes);
    if (is_swapped(file)) std::reverse(bytes.begin(), bytes.end());
    std::uint64_t word = 0;
    if (file.wide_headers) {
        std::memcpy(&word, raw.data(), 8);
    } else {
        std::uint32_t narrow = 0;
        std::memcpy(&narrow, raw.data(), 4);
        word = narrow;
    }
    constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 4096);
    if (word > kMax) bad_array(file, array, "its header says " + std::to_string(word) + " bytes", "less than the file has");
    return static_cast<std::int64_t>(word);
}

/// The bytes [offset, offset + length) of another source.
class PartSource final : public ByteSource {
public:
    /// is_last: no bytes may follow in the other source (appended arrays are followed by others).
    PartSource(std::unique_ptr<ByteSource> inner, std::int64_t offset, std::int64_t length, bool is_last)
        : inner_(std::move(inner)), offset_(offset), length_(length), is_last_(is_last) {
        inner_->seek(offset_);
    }
    void read(std::span<std::byte> out) override { inner_->read(out); }
    void seek(std::int64_t offset) override { inner_->seek(offset_ + offset); }
    std::int64_t payload_bytes(std::int64_t max) override {
        if (!is_last_) return max < length_ ? max + 1 : length_;
        const std::int64_t all = std::min(max, std::numeric_limits<std::int64_t>::max() - offset_ - 1) + offset_;
        return std::max<std::int64_t>(inner_->payload_bytes(all) - offset_, 0);
    }
    bool random_access() const override { return inner_->random_access(); }
    std::int64_t size_bound() const override { return std::min(length_, std::max<std::int64_t>(inner_->size_bound() - offset_, 0)); }
    const std::string& file() const override { return inner_->file(); }

private:
    std::unique_ptr<ByteSource> inner_;
    std::int64_t offset_, length_;
    bool is_last_;
};

/// These fill out, or return why they cannot.
std::string unpack_zlib(std::span<const std::byte> bytes, std::span<std::byte> out) {
    uLongf size = out.size();
    const int result =
        ::uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    if (result != Z_OK) return zError(result);
    return size == out.size() ? "" : "it is too short";
}

std::string unpack_lz4(std::span<const std::byte> bytes, std::span<std::byte> out) {
    constexpr std::size_t kMost = LZ4_MAX_INPUT_SIZE;
    if (bytes.size() > kMost || out.size() > kMost) return "LZ4 has no blocks of this size";
    const int size = ::LZ4_decompress_safe(reinterpret_cast<const char*>(bytes.data()), reinterpret_cast<char*>(out.data()),
                                           static_cast<int>(bytes.size()), static_cast<int>(out.size()));
    if (size < 0) return "it is no LZ4 block";
    return static_cast<std::size_t>(size) == out.size() ? "" : "it is too short";
}

/// Positions of the blocks of a compressed array.
struct BlockTable {
    std::int64_t data_begin = 0;   ///< position of the first block in the inner source
    std::int64_t block_bytes = 0;  ///< of every block but the last, decompressed
    std::int64_t last_bytes = 0;
    std::vector<std::int64_t> begin;  ///< start of each block relative to data_begin; and the end of the last
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(begin.size()) - 1; }
    [[nodiscard]] std::int64_t bytes_of(std::int64_t block) const { return block + 1 == count() ? last_bytes : block_bytes; }
    [[nodiscard]] std::int64_t bytes() const { return count() == 0 ? 0 : (count() - 1) * block_bytes + last_bytes; }
};

/// Blocks compressed one by one, [count][block size][size of a partial last block, or 0][compressed size]...
class BlockSource final : public ByteSource {
public:
    BlockSource(const VtkFile& file, const VtkArray& array, std::unique_ptr<ByteSource> inner)
        : file_(file), array_(array), inner_(std::move(inner)) {
        read_table();
    }
    void read(std::span<std::byte> out) override {
        while (!out.empty()) {
            const std::int64_t block = position_ / table_.block_bytes;
            if (position_ >= table_.bytes()) bad_array(file_, array_, "the data end early", std::to_string(out.size()) + " more bytes");
            const auto begin = static_cast<std::size_t>(position_ - block * table_.block_bytes);
            if (is_large(block)) {
                const auto left = static_cast<std::size_t>(table_.bytes_of(block)) - begin;
                const std::size_t count = std::min(out.size(), left);
                stream(block, static_cast<std::int64_t>(begin), out.first(count));
                out = out.subspan(count);
                position_ += static_cast<std::int64_t>(count);
                continue;
            }
            load(block);
            const std::size_t count = std::min(out.size(), block_.size() - begin);
            std::memcpy(out.data(), block_.data() + begin, count);
            out = out.subspan(count);
            position_ += static_cast<std::int64_t>(count);
        }
    }
    void seek(std::int64_t offset) override { position_ = offset; }
    std::int64_t payload_bytes(std::int64_t max) override { return max < table_.bytes() ? max + 1 : table_.bytes(); }
    bool random_access() const override { return inner_->random_access(); }
    std::int64_t size_bound() const override { return table_.bytes(); }
    const std::string& file() const override { return inner_->file(); }

private:
    void read_table() {
        inner_->seek(0);
        const std::int64_t count = read_word(*inner_, file_, array_);
        const std::int64_t word = file_.wide_headers ? 8 : 4, bound = inner_->size_bound();
        table_.block_bytes = read_word(*inner_, file_, array_);
        const std::int64_t partial = read_word(*inner_, file_, array_);
        if (count > bound / word)
            bad_array(file_, array_, "its header lists " + std::to_string(count) + " blocks", "no more than the file holds");
        if (count > 0 && (table_.block_bytes < 1 || partial > table_.block_bytes)) {
            bad_array(file_, array_,
                      "its blocks have " + std::to_string(table_.block_bytes) + " bytes, the last one " + std::to_string(partial),
                      "blocks of one size, the last one smaller");
        }
        table_.last_bytes = partial == 0 ? table_.block_bytes : partial;
        table_.begin.push_back(0);
        for (std::int64_t block = 0; block < count; ++block) {
            const std::int64_t compressed = read_word(*inner_, file_, array_);
            table_.begin.push_back(table_.begin.back() + compressed);
            const std::int64_t wanted = block + 1 == count ? table_.last_bytes : table_.block_bytes;
            if (table_.begin.back() > bound || wanted / largest_vtk_ratio(file_.compressor) > compressed) {
                bad_array(file_, array_,
                          "block " + std::to_string(block) + " of " + std::to_string(wanted) + " bytes cannot be in " +
                              std::to_string(compressed) + " bytes",
                          "blocks inside the file");
            }
        }
        table_.data_begin = (count + 3) * word;
    }
    /// Too large to be decompressed as a whole, where the code allows less.
    [[nodiscard]] bool is_large(std::int64_t block) const {
        if (file_.compressor != VtkCompressor::zlib) return false;
        constexpr std::int64_t kWhole = std::int64_t{1} << 20;
        const auto index = static_cast<std::size_t>(block);
        return table_.bytes_of(block) > kWhole || table_.begin[index + 1] - table_.begin[index] > kWhole;
    }
    /// Bytes of a large block from an offset on: the bytes before it are decompressed and discarded.
    void stream(std::int64_t block, std::int64_t offset, std::span<std::byte> out) {
        const auto index = static_cast<std::size_t>(block);
        if (!inflater_) inflater_ = std::make_unique<BlockInflater>();
        if (streamed_ != block || inflater_->position() > offset) {
            inner_->seek(table_.data_begin + table_.begin[index]);
            inflater_->start(table_.begin[index + 1] - table_.begin[index], table_.bytes_of(block));
        }
        streamed_ = -1, loaded_ = -1;
        std::array<std::byte, 1 << 14> passed;
        const auto read = [&](std::span<std::byte> bytes) {
            const std::string problem = inflater_->read(*inner_, bytes);
            if (problem.empty()) return;
            bad_array(file_, array_, "block " + std::to_string(block) + " is corrupt (" + problem + ")",
                      std::to_string(table_.bytes_of(block)) + " bytes");
        };
        while (inflater_->position() < offset) {
            read(std::span(passed).first(static_cast<std::size_t>(std::min<std::int64_t>(1 << 14, offset - inflater_->position()))));
        }
        read(out);
        streamed_ = block;
    }
    void load(std::int64_t block) {
        if (block == loaded_) return;
        const auto index = static_cast<std::size_t>(block);
        compressed_.resize(static_cast<std::size_t>(table_.begin[index + 1] - table_.begin[index]));
        block_.resize(static_cast<std::size_t>(table_.bytes_of(block)));
        loaded_ = streamed_ = -1;
        inner_->seek(table_.data_begin + table_.begin[index]);
        inner_->read(compressed_);
        const std::string problem =
            file_.compressor == VtkCompressor::lz4 ? unpack_lz4(compressed_, block_) : unpack_zlib(compressed_, block_);
        if (!problem.empty()) {
            bad_array(file_, array_, "block " + std::to_string(block) + " is corrupt (" + problem + ")",
                      std::to_string(block_.size()) + " bytes");
        }
        loaded_ = block;
    }

    VtkFile file_;
    VtkArray array_;
    std::unique_ptr<ByteSource> inner_;
    BlockTable table_;
    std::int64_t position_ = 0, loaded_ = -1;
    std::vector<std::byte> block_, compressed_;
    std::unique_ptr<BlockInflater> inflater_;
    std::int64_t streamed_ = -1;  ///< the current block of inflater_
};

/// The header and the data of an array as bytes.
std::unique_ptr<ByteSource> open_encoded(const VtkFile& file, const VtkArray& array) {
    if (array.format == VtkFormat::binary) return open_base64_source(file.open(), file.path, array.begin, array.end);
    std::unique_ptr<File> bytes = file.open();
    const std::int64_t size = bytes->size();
    if (file.appended < 0) bad_array(file, array, "its data are in an appended section that the file does not have", "<AppendedData>");
    if (array.offset < 0 || array.offset >= size - file.appended) {
        bad_array(file, array, "its data start at " + std::to_string(array.offset) + " in the appended section",
                  "less than " + std::to_string(size - file.appended));
    }
    const std::int64_t begin = file.appended + array.offset;
    return file.appended_is_raw ? open_file_source(std::move(bytes), file.path, begin)
                                : open_base64_source(std::move(bytes), file.path, begin, size);
}

/// The data of an array that is not ascii; length: bytes that its header says.
std::unique_ptr<ByteSource> open_data(const VtkFile& file, const VtkArray& array, std::int64_t& length) {
    std::unique_ptr<ByteSource> source = open_encoded(file, array);
    if (file.compressor != VtkCompressor::none) {
        source = std::make_unique<BlockSource>(file, array, std::move(source));
        length = source->size_bound();
        return source;
    }
    length = read_word(*source, file, array);
    return std::make_unique<PartSource>(std::move(source), file.wide_headers ? 8 : 4, length, array.format == VtkFormat::binary);
}

std::unique_ptr<ByteSource> open_text(const VtkFile& file, const VtkArray& array) {
    return open_file_source(file.open(), file.path, array.begin, array.end - array.begin);
}

template <class T>
void append(std::span<const std::byte> bytes, bool swapped, VtkValues& values) {
    for (; bytes.size() >= sizeof(T); bytes = bytes.subspan(sizeof(T))) {
        std::array<std::byte, sizeof(T)> raw;
        std::copy_n(bytes.begin(), sizeof(T), raw.begin());
        if (swapped) std::reverse(raw.begin(), raw.end());
        const T value = std::bit_cast<T>(raw);
        if constexpr (std::is_floating_point_v<T>) {
            values.reals.push_back(value);
        } else {
            values.integers.push_back(static_cast<std::int64_t>(value));
        }
    }
}

struct NumericType {
    std::string_view name;
    std::size_t bytes;
    bool is_real;
    void (*append)(std::span<const std::byte>, bool, VtkValues&);
};
template <class T>
constexpr NumericType numeric(std::string_view name) {
    return {name, sizeof(T), std::is_floating_point_v<T>, append<T>};
}
constexpr std::array kNumericTypes{numeric<std::int8_t>("Int8"),     numeric<std::uint8_t>("UInt8"),   numeric<std::int16_t>("Int16"),
                                   numeric<std::uint16_t>("UInt16"), numeric<std::int32_t>("Int32"),   numeric<std::uint32_t>("UInt32"),
                                   numeric<std::int64_t>("Int64"),   numeric<std::uint64_t>("UInt64"), numeric<float>("Float32"),
                                   numeric<double>("Float64")};

const NumericType& numeric_type(const VtkFile& file, const VtkArray& array) {
    const auto found = std::ranges::find(kNumericTypes, array.type, &NumericType::name);
    if (found != kNumericTypes.end()) return *found;
    throw Error(ErrorKind::unsupported, {.file = file.path,
                                         .where = "array " + in_quotes(array.name),
                                         .what = "type " + in_quotes(array.type) + " is not numeric",
                                         .expected = "Int8 to UInt64, Float32 or Float64",
                                         .next = "write the file again with VTK or ParaView"});
}

template <class T>
void parse_values(const VtkFile& file, const VtkArray& array, std::vector<T>& values) {
    const std::unique_ptr<ByteSource> source = open_text(file, array);
    std::string text(static_cast<std::size_t>(source->size_bound()), '\0');
    source->read(std::as_writable_bytes(std::span(text)));
    for (const std::string_view word : split_words(text)) {
        T value;
        if (!parse_number(word, value))
            bad_array(file, array, in_quotes(word) + " is not a number of its type",
                      "number " + std::to_string(values.size() + 1) + ": " + array.type);
        values.push_back(value);
    }
}

void read_values(const VtkFile& file, const VtkArray& array, const NumericType& type, std::int64_t budget, VtkValues& values) {
    std::int64_t length = 0;
    const std::unique_ptr<ByteSource> source = open_data(file, array, length);
    const auto size = static_cast<std::int64_t>(type.bytes);
    if (length > source->size_bound())
        bad_array(file, array, "its header says " + std::to_string(length) + " bytes", std::to_string(source->size_bound()) + " at most");
    if (length % size != 0)
        bad_array(file, array, "it has " + std::to_string(length) + " bytes", "a multiple of " + std::to_string(size) + ": " + array.type);
    if (length / size > budget) return require_budget(file, array, budget - length / size);
    std::vector<std::byte> bytes(static_cast<std::size_t>(length));
    source->seek(0);
    source->read(bytes);
    type.append(bytes, is_swapped(file), values);
}

}  // namespace

std::unique_ptr<ByteSource> open_vtk_array(const VtkFile& file, const VtkArray& array, ValueType type, std::int64_t count,
                                           WideInteger wide) {
    if (array.format == VtkFormat::ascii) return open_text_source(open_text(file, array), type, TextEnd::anything, wide);
    const std::int64_t wanted = count * static_cast<std::int64_t>(size_of(type));
    std::int64_t length = 0;
    std::unique_ptr<ByteSource> source = open_data(file, array, length);
    if (length > wanted && !file.skip_rest) refuse_rest(file.path, length - wanted);
    if (length < wanted)
        bad_array(file, array, "it has " + std::to_string(length) + " bytes", std::to_string(wanted) + " bytes for the extent");
    return source;
}

VtkValues read_vtk_values(const VtkFile& file, const VtkArray& array, std::int64_t& budget) {
    const NumericType& type = numeric_type(file, array);
    VtkValues values;
    values.is_real = type.is_real;
    if (array.format != VtkFormat::ascii) {
        read_values(file, array, type, budget, values);
    } else if (type.is_real) {
        parse_values(file, array, values.reals);
    } else {
        parse_values(file, array, values.integers);
    }
    budget -= static_cast<std::int64_t>(values.size());
    require_budget(file, array, budget);
    return values;
}

std::int64_t largest_vtk_ratio(VtkCompressor compressor) {
    switch (compressor) {
        case VtkCompressor::zlib: return 1032;
        case VtkCompressor::lz4: return 255;
        case VtkCompressor::none: break;
    }
    return 1;
}

std::string vtk_encoding(const VtkFile& file, const VtkArray& array) {
    if (array.format == VtkFormat::ascii) return "ascii";
    const bool raw = array.format == VtkFormat::appended && file.appended_is_raw;
    const char* compressor = file.compressor == VtkCompressor::zlib ? " zlib" : file.compressor == VtkCompressor::lz4 ? " LZ4" : "";
    return std::string(raw ? "raw" : "base64") + compressor;
}

}  // namespace isoatlas
