// NetCDF files of the classic format: version 1, 2 (64-bit offsets) and 5 (64-bit sizes).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include "base/check.h"
#include "formats/common/byte_cursor.h"
#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/netcdf_file.h"
#include "formats/volume/sample_reader.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr int kDimensionTag = 10, kVariableTag = 11, kAttributeTag = 12;

struct ClassicType {
    const char* name;
    std::int64_t bytes;
    std::optional<ValueType> value;
    WideInteger wide = WideInteger::none;
};
/// By their numbers in the file, from 1 on.
constexpr std::array<ClassicType, 11> kClassicTypes{{{"int8", 1, ValueType::i8},
                                                     {"text", 1, std::nullopt},
                                                     {"int16", 2, ValueType::i16},
                                                     {"int32", 4, ValueType::i32},
                                                     {"float32", 4, ValueType::f32},
                                                     {"float64", 8, ValueType::f64},
                                                     {"uint8", 1, ValueType::u8},
                                                     {"uint16", 2, ValueType::u16},
                                                     {"uint32", 4, ValueType::u32},
                                                     {"int64", 8, ValueType::f64, WideInteger::int64},
                                                     {"uint64", 8, ValueType::f64, WideInteger::uint64}}};
constexpr std::size_t kTextType = 1;  // place in the table

struct ClassicAttribute {
    std::string text{};
    std::vector<double> numbers{};
    std::vector<std::uint64_t> integers{};  ///< bits of those that are integers
};

struct ClassicVariable {
    std::map<std::string, ClassicAttribute> attributes{};
    std::size_t type = 0;
    std::int64_t begin = 0;
    bool is_record = false;
    std::vector<std::int64_t> stride{};  ///< bytes from one index to the next, for each dimension
};

/// a * b, at most the largest number.
std::int64_t bounded_product(std::int64_t a, std::int64_t b) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    return a != 0 && b > kMost / a ? kMost : a * b;
}

double classic_number(const char* bytes, std::size_t type) {
    const auto as = [bytes]<class T>(T) {
        std::array<char, sizeof(T)> raw{};
        std::reverse_copy(bytes, bytes + sizeof(T), raw.begin());
        T value;
        std::memcpy(&value, raw.data(), sizeof(T));
        return static_cast<double>(value);
    };
    const ClassicType& kind = kClassicTypes[type];
    if (kind.wide != WideInteger::none) return kind.wide == WideInteger::int64 ? as(std::int64_t{}) : as(std::uint64_t{});
    return visit_type(*kind.value, as);
}

/// nullopt: it is none.
std::optional<std::uint64_t> classic_integer(const char* bytes, std::size_t type) {
    if (kClassicTypes[type].wide == WideInteger::none) {
        const double number = classic_number(bytes, type);
        if (std::trunc(number) != number || std::abs(number) > 0x1p53) return std::nullopt;
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(number));
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
    return bits;
}

class ClassicFile final : public NetcdfFile {
public:
    ClassicFile(const std::string& file, std::string_view header, std::int64_t size) : size_(size), cursor_(header, path) {
        path = file;
        version_ = std::to_integer<int>(std::byte(cursor_.bytes(4, "the signature")[3]));
        format = version_ == 1 ? "NetCDF classic" : version_ == 2 ? "NetCDF 64-bit offset" : "NetCDF 64-bit data";
        const std::int64_t records = version_ == 5 ? cursor_.number<std::int64_t>(true, "the number of records")
                                                   : cursor_.number<std::int32_t>(true, "the number of records");
        read_dimensions();
        static_cast<void>(read_attributes());
        read_variables();
        set_records(records);
    }

    [[nodiscard]] std::string text(const NetcdfVariable& variable, const std::string& attribute) const override {
        const ClassicAttribute* found = find(variable, attribute);
        return found == nullptr ? std::string() : found->text;
    }
    [[nodiscard]] std::vector<double> numbers(const NetcdfVariable& variable, const std::string& attribute) const override {
        const ClassicAttribute* found = find(variable, attribute);
        return found == nullptr ? std::vector<double>() : found->numbers;
    }
    [[nodiscard]] std::vector<std::uint64_t> integers(const NetcdfVariable& variable, const std::string& attribute) const override {
        const ClassicAttribute* found = find(variable, attribute);
        return found == nullptr ? std::vector<std::uint64_t>() : found->integers;
    }
    [[nodiscard]] Hdf5Array array(const NetcdfVariable& variable) const override {
        Hdf5Array array{.path = variable.path, .type = variable.type, .encoding = "raw"};
        for (const std::size_t d : variable.dimensions) array.dims.push_back(dimensions[d].size);
        return array;
    }
    [[nodiscard]] std::vector<double> line(const NetcdfVariable& variable) const override;
    [[nodiscard]] std::unique_ptr<VolumeReader> reader(VolumeInfo info, const NetcdfVariable& variable,
                                                       const Hdf5Place& place) const override;

private:
    [[nodiscard]] const ClassicVariable& own(const NetcdfVariable& variable) const {
        return own_[static_cast<std::size_t>(&variable - variables.data())];
    }
    [[nodiscard]] const ClassicAttribute* find(const NetcdfVariable& variable, const std::string& attribute) const {
        const auto found = own(variable).attributes.find(attribute);
        return found == own(variable).attributes.end() ? nullptr : &found->second;
    }
    /// Sizes and numbers of things.
    std::int64_t count(const char* of_what) {
        const std::int64_t value = version_ == 5 ? cursor_.number<std::int64_t>(true, of_what)
                                                 : static_cast<std::int64_t>(cursor_.number<std::uint32_t>(true, of_what));
        if (value < 0) cursor_.fail_at_offset(std::string(of_what) + " is negative");
        return value;
    }
    std::string padded_text(std::int64_t size, const char* of_what) {
        const std::string text(cursor_.bytes(static_cast<std::size_t>(size), of_what));
        static_cast<void>(cursor_.bytes(static_cast<std::size_t>((4 - size % 4) % 4), of_what));
        return text;
    }
    std::string name(const char* of_what) { return padded_text(count(of_what), of_what); }
    /// How many things of a list follow.
    std::int64_t list(int tag, const char* of_what) {
        const auto found = cursor_.number<std::int32_t>(true, of_what);
        const std::int64_t things = count(of_what);
        if (found != tag && (found != 0 || things != 0)) cursor_.fail_at_offset("a list of " + std::string(of_what) + " is expected");
        return things;
    }
    std::size_t type(const char* of_what) {
        const auto number = cursor_.number<std::int32_t>(true, of_what);
        if (number < 1 || number > (version_ == 5 ? 11 : 6)) cursor_.fail_at_offset("the type " + std::to_string(number) + " is unknown");
        return static_cast<std::size_t>(number - 1);
    }

    void read_dimensions() {
        for (std::int64_t left = list(kDimensionTag, "dimensions"); left > 0; --left) {
            const std::string given = name("a dimension");
            const std::int64_t size = count("a dimension");
            if (size == 0 && std::ranges::any_of(dimensions, &NetcdfDimension::is_unlimited))
                cursor_.fail_at_offset(shown_name(given) + " is a second dimension of records");
            dimensions.push_back({given, size, size == 0});
        }
    }
    std::map<std::string, ClassicAttribute> read_attributes() {
        std::map<std::string, ClassicAttribute> attributes;
        for (std::int64_t left = list(kAttributeTag, "attributes"); left > 0; --left) {
            const std::string given = name("an attribute");
            const std::size_t kind = type("an attribute");
            const std::int64_t values = count("an attribute"), bytes = bounded_product(values, kClassicTypes[kind].bytes);
            const std::string content = padded_text(bytes, "an attribute");
            ClassicAttribute& attribute = attributes[given];
            if (kind == kTextType) {
                attribute.text = content.substr(0, content.find('\0'));
                continue;
            }
            for (std::size_t i = 0; i < content.size(); i += static_cast<std::size_t>(kClassicTypes[kind].bytes)) {
                attribute.numbers.push_back(classic_number(content.data() + i, kind));
                if (const auto integer = classic_integer(content.data() + i, kind)) attribute.integers.push_back(*integer);
            }
        }
        return attributes;
    }
    void read_variables() {
        for (std::int64_t left = list(kVariableTag, "variables"); left > 0; --left) {
            NetcdfVariable variable{.path = "/" + name("a variable")};
            ClassicVariable own;
            for (std::int64_t rank = count("a variable"); rank > 0; --rank) {
                const std::int64_t d = count("a dimension of a variable");
                if (d >= static_cast<std::int64_t>(dimensions.size())) cursor_.fail_at_offset("there is no dimension " + std::to_string(d));
                if (dimensions[static_cast<std::size_t>(d)].is_unlimited && !variable.dimensions.empty())
                    cursor_.fail_at_offset("the records of " + shown_name(variable.path) + " are not its first dimension");
                variable.dimensions.push_back(static_cast<std::size_t>(d));
            }
            own.attributes = read_attributes();
            own.type = type("a variable");
            static_cast<void>(count("a variable"));  // its size, which follows from the dimensions
            own.begin = version_ == 1 ? static_cast<std::int64_t>(cursor_.number<std::uint32_t>(true, "a variable"))
                                      : cursor_.number<std::int64_t>(true, "a variable");
            if (own.begin < 0) cursor_.fail_at_offset("the samples of " + shown_name(variable.path) + " begin before the file");
            const ClassicType& kind = kClassicTypes[own.type];
            variable.type = {.name = kind.name,
                             .value = kind.value,
                             .is_number = own.type != kTextType,
                             .big_endian = kind.bytes > 1,
                             .wide = kind.wide};
            own.is_record = !variable.dimensions.empty() && dimensions[variable.dimensions[0]].is_unlimited;
            variables.push_back(std::move(variable));
            own_.push_back(std::move(own));
        }
    }
    /// Bytes from one record to the next, and how many there are: the number in the header is -1 while a file is being written.
    void set_records(std::int64_t records) {
        std::int64_t record_bytes = 0, last_bytes = 0, first_begin = std::numeric_limits<std::int64_t>::max();
        int record_variables = 0;
        for (std::size_t v = 0; v < variables.size(); ++v) {
            ClassicVariable& own = own_[v];
            const std::vector<std::size_t>& dims = variables[v].dimensions;
            own.stride.assign(dims.size(), 0);
            std::int64_t bytes = kClassicTypes[own.type].bytes;
            for (std::size_t d = dims.size(); d-- > (own.is_record ? 1U : 0U);) {
                own.stride[d] = bytes;
                bytes = bounded_product(bytes, dimensions[dims[d]].size);
            }
            if (!own.is_record) continue;
            constexpr std::int64_t kPadding = 4;
            const std::int64_t room = std::max<std::int64_t>(std::numeric_limits<std::int64_t>::max() - kPadding - record_bytes, 0);
            const std::int64_t added = std::min(bytes, room);
            record_bytes += added + (kPadding - added % kPadding) % kPadding;
            last_bytes = bytes, first_begin = std::min(first_begin, own.begin);
            ++record_variables;
        }
        if (record_variables == 1) record_bytes = last_bytes;  // of a single variable records are not filled up
        if (records < 0) records = record_bytes > 0 && size_ > first_begin ? (size_ - first_begin) / record_bytes : 0;
        for (NetcdfDimension& dimension : dimensions) {
            if (dimension.is_unlimited) dimension.size = records;
        }
        for (ClassicVariable& own : own_) {
            if (own.is_record) own.stride[0] = record_bytes;
        }
    }

    std::int64_t size_;
    ByteCursor cursor_;
    int version_ = 1;
    std::vector<ClassicVariable> own_;  ///< for each of variables
};

/// Samples at any strides, big endian.
class ClassicReader final : public VolumeReader {
public:
    ClassicReader(VolumeInfo info, std::int64_t begin, const Index3& stride, const Hdf5Place& place)
        : file_(open_file(info.path)),
          begin_(begin),
          stride_(stride),
          sample_(static_cast<std::int64_t>(size_of(info.type))),
          wide_(place.wide) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (place.flipped[a]) begin_ += (info.extent.size[a] - 1) * stride_[a], stride_[a] = -stride_[a];
        }
        info_ = std::move(info);
        tidy_texts(info_);
        info_.slab_readable = true;
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        if (z_begin < z_end) read_box({{0, 0, z_begin}, {info_.extent.size[0], info_.extent.size[1], z_end}}, out);
    }
    void read_box(const SampleBox& box, std::span<std::byte> out) override {
        ISOATLAS_CHECK(is_inside(box, info_.extent));
        const Index3 size = box.size();
        ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) == size.product() * sample_);
        const bool are_rows = stride_[0] == sample_, are_slices = are_rows && stride_[1] == size[0] * sample_;
        const std::int64_t rows = are_slices ? 1 : size[1];
        const std::size_t bytes = static_cast<std::size_t>(size[0] * (are_slices ? size[1] : 1) * sample_);
        std::size_t done = 0;
        for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
            for (std::int64_t y = 0; y < rows; ++y, done += bytes) {
                const std::int64_t at = begin_ + box.begin[0] * stride_[0] + (box.begin[1] + y) * stride_[1] + z * stride_[2];
                const std::span<std::byte> part = out.subspan(done, bytes);
                if (are_rows)
                    read_fully(*file_, info_.path, at, part);
                else
                    read_row(at, part);
                if (needs_swap(true)) swap_bytes(part, static_cast<std::size_t>(sample_));  // while it is in the cache
                doubles_of_integers(part, wide_, info_.path);
            }
        }
    }

private:
    /// Samples that are not neighbours, through a buffer.
    void read_row(std::int64_t at, std::span<std::byte> out) {
        constexpr std::int64_t kBuffer = std::int64_t{1} << 20;
        const std::int64_t step = stride_[0] < 0 ? -stride_[0] : stride_[0], count = static_cast<std::int64_t>(out.size()) / sample_;
        const std::int64_t at_once = std::max<std::int64_t>(kBuffer / step, 1);
        std::vector<std::byte> buffer;
        for (std::int64_t i = 0; i < count; i += at_once) {
            const std::int64_t some = std::min(at_once, count - i), last = i + some - 1;
            buffer.resize(static_cast<std::size_t>((some - 1) * step + sample_));
            read_fully(*file_, info_.path, at + (stride_[0] < 0 ? last : i) * stride_[0], buffer);
            for (std::int64_t k = 0; k < some; ++k) {
                const std::int64_t from = (stride_[0] < 0 ? some - 1 - k : k) * step;
                std::memcpy(out.data() + (i + k) * sample_, buffer.data() + from, static_cast<std::size_t>(sample_));
            }
        }
    }

    std::unique_ptr<File> file_;
    std::int64_t begin_;
    Index3 stride_;
    std::int64_t sample_;
    WideIntegers wide_;
};

std::vector<double> ClassicFile::line(const NetcdfVariable& variable) const {
    const Hdf5Array shape = array(variable);
    if (shape.dims.size() != 1 || !shape.type.is_number || (shape.dims[0] > Hdf5File::kMostNumbers && shape.dims[0] <= size_)) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .where = shown_name(variable.path),
                                             .what = "is not a list of at most " + std::to_string(Hdf5File::kMostNumbers) + " numbers",
                                             .next = "choose another variable"});
    }
    const ClassicVariable& own = this->own(variable);
    const std::unique_ptr<File> file = open_file(path);
    const std::int64_t number = kClassicTypes[own.type].bytes, stride = own.stride[0], count = shape.dims[0];
    if (own.begin > size_ || bounded_product(stride, count - 1) > size_ - own.begin)
        bad_field(path, variable.path, "the file ends before its numbers", std::to_string(count) + " numbers");
    std::vector<double> values;
    std::vector<std::byte> bytes;
    const std::int64_t at_once = stride == number ? 65536 : 1;
    for (std::int64_t i = 0; i < count; i += at_once) {
        bytes.resize(static_cast<std::size_t>(std::min(at_once, count - i) * number));
        read_fully(*file, path, own.begin + i * stride, bytes);
        for (std::size_t at = 0; at < bytes.size(); at += static_cast<std::size_t>(number))
            values.push_back(classic_number(reinterpret_cast<const char*>(bytes.data()) + at, own.type));
    }
    return values;
}

std::unique_ptr<VolumeReader> ClassicFile::reader(VolumeInfo info, const NetcdfVariable& variable, const Hdf5Place& place) const {
    const ClassicVariable& own = this->own(variable);
    if (!variable.type.value) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .where = shown_name(variable.path),
                                             .what = std::string(variable.type.name) + " samples are not supported",
                                             .expected = "8 to 64 bit integers, float32 or float64",
                                             .next = "convert the variable, for example to float64"});
    }
    static_cast<void>(sample_bytes(path, info.extent, info.type));
    // Every index is below its size, so that the end of the last sample bounds all.
    std::int64_t begin = own.begin, end = kClassicTypes[own.type].bytes;
    Index3 stride{0, 0, 0};
    for (std::size_t d = 0; d < own.stride.size(); ++d) {
        const std::int64_t size = dimensions[variable.dimensions[d]].size;
        end = std::min(end, std::numeric_limits<std::int64_t>::max() / 2) +
              std::min(bounded_product(own.stride[d], size - 1), std::numeric_limits<std::int64_t>::max() / 2);
    }
    if (begin > size_ || end > size_ - begin) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = shown_name(variable.path),
                                       .what = "the file has " + std::to_string(size_) + " bytes",
                                       .expected = std::to_string(end) + " bytes of samples from offset " + std::to_string(begin) + " on",
                                       .next = "the file is truncated: get it again"});
    }
    for (std::size_t d = 0; d < own.stride.size(); ++d) begin += own.stride[d] * place.index[d];
    for (std::size_t a = 0; a < 3; ++a) {
        if (place.dimension[a] >= 0) stride[a] = own.stride[static_cast<std::size_t>(place.dimension[a])];
    }
    return std::make_unique<ClassicReader>(std::move(info), begin, stride, place);
}

}  // namespace

std::unique_ptr<NetcdfFile> open_classic_netcdf(const std::string& path) {
    const std::int64_t size = file_size(path);
    for (std::int64_t most = std::int64_t{1} << 20;; most <<= 4) {
        const std::vector<std::byte> bytes = read_header_bytes(path, most);
        try {
            return std::make_unique<ClassicFile>(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), size);
        } catch (const Error&) {
            constexpr std::int64_t kMostOfHeader = std::int64_t{256} << 20;
            if (static_cast<std::int64_t>(bytes.size()) < most || most >= kMostOfHeader) throw;
        }
    }
}

}  // namespace isoatlas
