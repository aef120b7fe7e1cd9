// NRRD, versions 1 to 5, attached (.nrrd) and detached (.nhdr). Format: http://teem.sourceforge.net/nrrd/format.html
//
// Key/value pairs calibration_slope and calibration_intercept (of isoatlas) are the calibration; NRRD itself has no such field.
#include <bit>
#include <cmath>
#include <utility>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/data_files.h"
#include "formats/volume/formats.h"
#include "formats/volume/named_type.h"
#include "formats/volume/nrrd_geometry.h"
#include "formats/volume/nrrd_header.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

NamedType sample_type(const NrrdHeader& header) {
    static constexpr NamedType kTypes[] = {
        {"signed char", ValueType::i8},
        {"int8", ValueType::i8},
        {"int8_t", ValueType::i8},
        {"char", ValueType::i8},
        {"uchar", ValueType::u8},
        {"unsigned char", ValueType::u8},
        {"uint8", ValueType::u8},
        {"uint8_t", ValueType::u8},
        {"short", ValueType::i16},
        {"short int", ValueType::i16},
        {"signed short", ValueType::i16},
        {"signed short int", ValueType::i16},
        {"int16", ValueType::i16},
        {"int16_t", ValueType::i16},
        {"ushort", ValueType::u16},
        {"unsigned short", ValueType::u16},
        {"unsigned short int", ValueType::u16},
        {"uint16", ValueType::u16},
        {"uint16_t", ValueType::u16},
        {"int", ValueType::i32},
        {"signed int", ValueType::i32},
        {"int32", ValueType::i32},
        {"int32_t", ValueType::i32},
        {"uint", ValueType::u32},
        {"unsigned int", ValueType::u32},
        {"uint32", ValueType::u32},
        {"uint32_t", ValueType::u32},
        {"float", ValueType::f32},
        {"float32", ValueType::f32},
        {"double", ValueType::f64},
        {"float64", ValueType::f64},
        {"longlong", ValueType::f64, WideInteger::int64},
        {"long long", ValueType::f64, WideInteger::int64},
        {"long long int", ValueType::f64, WideInteger::int64},
        {"signed long long", ValueType::f64, WideInteger::int64},
        {"signed long long int", ValueType::f64, WideInteger::int64},
        {"int64", ValueType::f64, WideInteger::int64},
        {"int64_t", ValueType::f64, WideInteger::int64},
        {"ulonglong", ValueType::f64, WideInteger::uint64},
        {"unsigned long long", ValueType::f64, WideInteger::uint64},
        {"unsigned long long int", ValueType::f64, WideInteger::uint64},
        {"uint64", ValueType::f64, WideInteger::uint64},
        {"uint64_t", ValueType::f64, WideInteger::uint64},
    };
    if (!header.has("type")) header.fail(ErrorKind::input, "type", "is missing", "the type of the samples");
    const std::string name = lower(header.text("type"));
    if (const NamedType* type = find_named_type(kTypes, name)) return *type;
    const bool known = name == "block";
    header.fail(known ? ErrorKind::unsupported : ErrorKind::input, "type",
                in_quotes(name) + (known ? " samples are not supported" : " is not a NRRD type"), "8 to 64 bit integers, float or double",
                "convert the file, for example: unu convert -t double -i IN.nrrd -o OUT.nrrd");
}

struct NamedEncoding {
    Encoding encoding;
    const char* name;
};

NamedEncoding sample_encoding(const NrrdHeader& header) {
    const std::string name = lower(header.text("encoding"));
    if (name == "raw") return {Encoding::raw, "raw"};
    if (name == "gzip" || name == "gz") return {Encoding::deflate, "gzip"};
    if (name == "bzip2" || name == "bz2") return {Encoding::bzip2, "bzip2"};
    if (name == "ascii" || name == "text" || name == "txt") return {Encoding::text, "ascii"};
    const bool known = name == "hex" || name == "zrl";
    header.fail(known ? ErrorKind::unsupported : ErrorKind::input, "encoding",
                name.empty() ? "is missing" : in_quotes(name) + (known ? " is not supported" : " is not a NRRD encoding"),
                "raw, gzip, bzip2 or ascii", "convert the file, for example: unu save -f nrrd -e gzip -i IN.nrrd -o OUT.nrrd");
}

bool big_endian_samples(const NrrdHeader& header, ValueType type, Encoding encoding) {
    constexpr bool kHost = std::endian::native == std::endian::big;
    if (encoding == Encoding::text) return kHost;  // decoded here
    const std::string endian = lower(header.text("endian"));
    if (endian == "big" || endian == "little") return size_of(type) > 1 ? endian == "big" : false;
    if (!endian.empty() || size_of(type) > 1) {
        header.fail(ErrorKind::input, "endian", endian.empty() ? "is missing" : in_quotes(endian) + " is not a byte order", "little or big",
                    "add 'endian: little' (or big) to the header");
    }
    return false;
}

DataFiles data_files(const NrrdHeader& header) {
    const std::string value = header.text("data file");
    if (value.empty()) {
        if (header.ended) return {};
        header.fail(ErrorKind::input, "data file", "is missing, and no samples follow the header",
                    "a data file, or an empty line and samples", "the file is truncated, or its data file must be named in the header");
    }
    const std::vector<std::string_view> words = split_words(value);
    if (words[0] == "LIST") {
        if (header.listed_files.empty()) header.fail(ErrorKind::input, "data file", "the LIST is empty", "one file name per line");
        return {.names = header.listed_files, .pattern = {}};
    }
    if (words.size() >= 4 && has_number_directive(words[0])) {
        return parse_series(header.path, "field 'data file'", {words.begin(), words.begin() + 4});
    }
    return {.names = {value}, .pattern = {}};
}

std::int64_t skip_count(const NrrdHeader& header, const std::string& field, std::int64_t min) {
    if (!header.has(field)) return 0;
    const std::int64_t count = header.integers(field, 1)[0];
    if (count < min) header.fail(ErrorKind::input, field, "is " + std::to_string(count), "at least " + std::to_string(min));
    return count;
}

PayloadPlan payload_plan(const NrrdHeader& header, Encoding encoding, const NamedType& type, std::int64_t bytes,
                         const OpenOptions& options) {
    PayloadPlan plan;
    plan.skip_rest = options.skip_rest;
    plan.follow_links = options.follow_links;
    plan.header_path = header.path;
    plan.files = data_files(header);
    plan.encoding = encoding;
    plan.offset = plan.files.count() == 0 ? header.data_offset : 0;
    plan.line_skip = skip_count(header, "line skip", 0);
    const std::int64_t skip = skip_count(header, "byte skip", encoding == Encoding::raw ? -1 : 0);
    const bool is_compressed = encoding == Encoding::deflate || encoding == Encoding::bzip2;
    (is_compressed ? plan.inflated_skip : plan.skip) = skip;  // NRRD skips bytes after decompression
    plan.type = type.type;
    plan.wide = type.wide;
    plan.sample_bytes = bytes;
    return plan;
}

double key_value(const NrrdHeader& header, const std::string& key, double otherwise) {
    const auto found = header.values.find(key);
    if (found == header.values.end()) return otherwise;
    const std::optional<double> number = parse_number(found->second);
    if (!number) header.fail(ErrorKind::input, key, in_quotes(found->second) + " is not a number", "a number");
    return *number;
}

VolumeInfo describe_volume(const NrrdHeader& header, const NrrdAxes& axes, const NamedEncoding& encoding, ValueType type) {
    VolumeInfo info;
    info.path = header.path;
    info.format = "NRRD";
    info.encoding = encoding.name;
    info.type = type;
    info.big_endian = big_endian_samples(header, info.type, encoding.encoding);
    info.notes.insert(info.notes.end(), header.notes.begin(), header.notes.end());
    info.extent.rank = static_cast<int>(axes.spatial.size());
    for (std::size_t i = 0; i < axes.spatial.size(); ++i) info.extent.size[i] = axes.sizes[axes.spatial[i]];
    read_nrrd_geometry(header, axes, info);
    set_calibration(info, key_value(header, "calibration_slope", 1), key_value(header, "calibration_intercept", 0));
    info.value_unit = printable(header.text("sample units"));
    info.description = printable(header.text("content"));
    return info;
}

}  // namespace

bool looks_like_nrrd(FirstBytes first, const std::string&) {
    constexpr std::string_view kNrrd = "NRRD";
    return first.size() >= kNrrd.size() && std::string_view(reinterpret_cast<const char*>(first.data()), kNrrd.size()) == kNrrd;
}

std::unique_ptr<VolumeReader> open_nrrd(const std::string& path, const OpenOptions& options) {
    const NrrdHeader header = read_nrrd_header(path);
    std::vector<std::string> notes;
    const NrrdAxes axes = choose_nrrd_axes(header, notes);
    const NamedEncoding encoding = sample_encoding(header);
    const NamedType type = sample_type(header);
    VolumeInfo info = describe_volume(header, axes, encoding, type.type);
    info.notes.insert(info.notes.begin(), notes.begin(), notes.end());
    const TimeStep step = choose_time_step(path, options, axes.volumes);
    const PayloadPlan plan = payload_plan(header, encoding.encoding, type, sample_bytes(path, info.extent, info.type, step.count), options);
    std::unique_ptr<ByteSource> source = open_payload(plan);
    if (plan.files.count() > 0) info.data_file = data_file_path(plan, 0);
    info.file_bytes = bytes_on_disk(plan);
    return make_sample_reader(std::move(info), std::move(source), options, step, type.wide);
}

}  // namespace isoatlas
