// MetaImage, attached (.mha) and detached (.mhd). Format: https://itk.org/Wiki/ITK/MetaIO/Documentation
//
// TransformMatrix holds one direction per axis, axis after axis: its rows are the columns of Geometry::direction.
// Physical space: MetaImage coordinates are LPS by the convention of ITK, but files without AnatomicalOrientation often come from
// outside medicine, so the space is "LPS" when that field names an orientation and "unknown" otherwise.
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "formats/common/header_text.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/data_files.h"
#include "formats/volume/formats.h"
#include "formats/volume/metaimage_header.h"
#include "formats/volume/named_type.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

NamedType sample_type(const MetaHeader& header) {
    static constexpr NamedType kTypes[] = {{"met_char", ValueType::i8},
                                           {"met_ascii_char", ValueType::i8},
                                           {"met_uchar", ValueType::u8},
                                           {"met_short", ValueType::i16},
                                           {"met_ushort", ValueType::u16},
                                           {"met_int", ValueType::i32},
                                           {"met_uint", ValueType::u32},
                                           {"met_long", ValueType::i32},  // 4 bytes in MetaIO
                                           {"met_ulong", ValueType::u32},
                                           {"met_float", ValueType::f32},
                                           {"met_double", ValueType::f64},
                                           {"met_long_long", ValueType::f64, WideInteger::int64},
                                           {"met_ulong_long", ValueType::f64, WideInteger::uint64}};
    if (!header.has("elementtype")) header.fail(ErrorKind::input, "ElementType", "is missing", "MET_UCHAR, MET_SHORT, MET_FLOAT, ...");
    const std::string name = lower(header.text("elementtype"));
    if (const NamedType* type = find_named_type(kTypes, name)) return *type;
    const bool known =
        name == "met_other" || name == "met_string" || name == "met_none" || (name.starts_with("met_") && name.ends_with("_array"));
    header.fail(known ? ErrorKind::unsupported : ErrorKind::input, "ElementType",
                in_quotes(header.text("elementtype")) + (known ? " samples are not supported" : " is not a MetaImage type"),
                "8 to 64 bit integers, MET_FLOAT or MET_DOUBLE", "convert the file to MET_DOUBLE with the program that wrote it");
}

/// DimSize, checked: 2 to 4 sizes of at least 1.
std::vector<std::int64_t> sizes_of(const MetaHeader& header) {
    if (!header.has("ndims")) header.fail(ErrorKind::input, "NDims", "is missing", "2, 3 or 4");
    const std::int64_t dimensions = header.integer("ndims", 0);
    if (dimensions < 1) header.fail(ErrorKind::input, "NDims", "is " + std::to_string(dimensions), "2, 3 or 4");
    if (dimensions < 2 || dimensions > 4) {
        header.fail(ErrorKind::unsupported, "NDims", "the file has " + std::to_string(dimensions) + " axes", "2, 3, or 4 with time last",
                    "extract 3D volumes with the program that wrote it");
    }
    if (!header.has("dimsize")) header.fail(ErrorKind::input, "DimSize", "is missing", "one size per axis");
    std::vector<std::int64_t> sizes = header.integers("dimsize", static_cast<std::size_t>(dimensions));
    for (const std::int64_t size : sizes) {
        if (size < 1) header.fail(ErrorKind::input, "DimSize", "an axis has " + std::to_string(size) + " samples", "at least 1");
    }
    return sizes;
}

bool is_oriented(const std::string& orientation) {
    return orientation.size() == 3 && orientation.find_first_not_of("RLAPSIrlapsi") == std::string::npos;
}

void read_geometry(const MetaHeader& header, std::size_t dimensions, VolumeInfo& info) {
    const std::size_t spatial = static_cast<std::size_t>(info.extent.rank);
    const std::string matrix_field = header.first_of({"transformmatrix", "rotation", "orientation"});
    if (!matrix_field.empty()) {
        const std::vector<double> matrix = header.numbers(matrix_field, dimensions * dimensions);
        for (std::size_t axis = 0; axis < spatial; ++axis) {
            Vec3 direction{};
            std::copy_n(matrix.begin() + static_cast<std::ptrdiff_t>(axis * dimensions), spatial, direction.begin());
            set_axis_step(info, static_cast<int>(axis), direction);
        }
        require_frame(info);
    }
    const std::string spacing_field = header.first_of({"elementspacing", "elementsize"});
    if (!spacing_field.empty()) {
        const std::vector<double> spacing = header.numbers(spacing_field, dimensions);
        for (std::size_t axis = 0; axis < spatial; ++axis) {  // times the length of the direction, which is 1 in sound files
            set_axis_spacing(info, static_cast<int>(axis), spacing[axis] * info.geometry.spacing[axis]);
        }
    }
    const std::string origin_field = header.first_of({"offset", "position", "origin"});
    if (!origin_field.empty()) {
        const std::vector<double> origin = header.numbers(origin_field, dimensions);
        if (!std::all_of(origin.begin(), origin.end(), [](double x) { return std::isfinite(x); })) {
            header.fail(ErrorKind::input, origin_field, "is not finite", "the position of the first sample");
        }
        std::copy_n(origin.begin(), spatial, info.geometry.origin.begin());
    }
    info.geometry.space = is_oriented(header.text("anatomicalorientation")) ? "LPS" : "unknown";
    const std::string unit = header.text("distanceunits");
    info.geometry.unit = unit == "?" ? std::string() : printable(unit);
}

DataFiles data_files(const MetaHeader& header) {
    const std::string value = header.text("elementdatafile");
    const std::vector<std::string_view> words = split_words(value);
    if (words.empty()) header.fail(ErrorKind::input, "ElementDataFile", "is empty", "LOCAL or the name of the data file");
    if (words.size() == 1 && lower(words[0]) == "local") return {};
    if (words[0] == "LIST") {
        if (header.listed_files.empty()) header.fail(ErrorKind::input, "ElementDataFile", "the LIST is empty", "one file name per line");
        return {.names = header.listed_files, .pattern = {}};
    }
    if (words.size() >= 3 && has_number_directive(words[0])) return parse_series(header.path, "field ElementDataFile", words);
    return {.names = {value}, .pattern = {}};
}

Encoding sample_encoding(const MetaHeader& header) {
    const bool binary = header.flag("binarydata", true), compressed = header.flag("compresseddata", false);
    if (!binary && compressed) {
        header.fail(ErrorKind::input, "CompressedData", "is True although BinaryData is False", "binary or compressed samples");
    }
    if (compressed) return Encoding::deflate;
    return binary ? Encoding::raw : Encoding::text;
}

bool big_endian_samples(const MetaHeader& header, Encoding encoding, ValueType type) {
    const bool first = header.flag("binarydatabyteordermsb", false);
    const bool second = header.flag("elementbyteordermsb", first);
    if (header.has("binarydatabyteordermsb") && first != second) {
        header.fail(ErrorKind::input, "ElementByteOrderMSB", "contradicts BinaryDataByteOrderMSB", "one byte order");
    }
    if (encoding == Encoding::text) return std::endian::native == std::endian::big;  // decoded here
    return second && size_of(type) > 1;
}

PayloadPlan payload_plan(const MetaHeader& header, Encoding encoding, const NamedType& type, std::int64_t bytes,
                         const OpenOptions& options) {
    PayloadPlan plan;
    plan.skip_rest = options.skip_rest;
    plan.follow_links = options.follow_links;
    plan.header_path = header.path;
    plan.files = data_files(header);
    plan.encoding = encoding;
    plan.type = type.type;
    plan.wide = type.wide;
    plan.sample_bytes = bytes;
    const bool local = plan.files.count() == 0;
    plan.offset = local ? header.data_offset : 0;
    plan.skip = header.integer("headersize", 0);
    if (plan.skip < (encoding == Encoding::raw ? -1 : 0)) {
        header.fail(ErrorKind::input, "HeaderSize", "is " + std::to_string(plan.skip),
                    "0 or more, or -1 for raw samples at the end of the file");
    }
    if (local && plan.skip > 0) {  // from the start of the file, also when it contains this header
        if (plan.skip < header.data_offset)
            header.fail(ErrorKind::input, "HeaderSize", "lies inside this header", "the start of the samples");
        plan.skip -= header.data_offset;
    }
    return plan;
}

/// CompressedDataSize is not needed, as streams have an end mark, and is wrong in real files: a larger file is read with a note.
void check_compressed_size(const MetaHeader& header, const PayloadPlan& plan, VolumeInfo& info) {
    const std::int64_t claimed = header.integer("compresseddatasize", 0);
    if (claimed < 0) header.fail(ErrorKind::input, "CompressedDataSize", "is negative", "the size of the compressed samples");
    if (claimed == 0 || plan.encoding != Encoding::deflate || plan.files.count() > 1) return;
    const std::int64_t begin = plan.offset + plan.skip;
    const std::int64_t present = file_size(info.data_file.empty() ? header.path : info.data_file) - begin;
    if (claimed == present) return;
    const std::string sizes = "is " + std::to_string(claimed) + ", but there are " + std::to_string(present) + " bytes";
    if (claimed > present) {
        header.fail(ErrorKind::input, "CompressedDataSize", sizes, "all compressed samples", "the file is truncated: get it again");
    }
    info.notes.push_back("CompressedDataSize " + sizes + ": all were read");
}

void refuse_other_objects(const MetaHeader& header) {
    const std::string object = header.text("objecttype");
    if (!object.empty() && lower(object) != "image") {
        header.fail(ErrorKind::unsupported, "ObjectType", "the file holds a " + in_quotes(object), "Image", "choose a MetaImage file");
    }
    const std::int64_t channels = header.integer("elementnumberofchannels", 1);
    if (channels < 1) header.fail(ErrorKind::input, "ElementNumberOfChannels", "is " + std::to_string(channels), "1");
    if (channels > 1) {
        header.fail(ErrorKind::unsupported, "ElementNumberOfChannels", "each sample has " + std::to_string(channels) + " values",
                    "one value per sample", "extract one channel with the program that wrote it");
    }
}

}  // namespace

bool looks_like_metaimage(FirstBytes first, const std::string&) {
    const std::string start = lower({reinterpret_cast<const char*>(first.data()), std::min<std::size_t>(first.size(), 512)});
    std::size_t begin = 0;
    std::string_view line;
    while (begin < start.size() && (line.empty() || line.starts_with('#'))) line = trim(take_line(start, begin));
    for (const std::string_view field : {"objecttype", "ndims", "comment", "objectsubtype"}) {
        if (line.starts_with(field) && line.find('=') != std::string_view::npos) return true;
    }
    return false;
}

std::unique_ptr<VolumeReader> open_metaimage(const std::string& path, const OpenOptions& options) {
    const MetaHeader header = read_metaimage_header(path);
    refuse_other_objects(header);
    const std::vector<std::int64_t> sizes = sizes_of(header);
    const Encoding encoding = sample_encoding(header);
    VolumeInfo info;
    info.path = path;
    info.format = "MetaImage";
    info.encoding = encoding == Encoding::raw ? "raw" : encoding == Encoding::deflate ? "zlib" : "ascii";
    const NamedType type = sample_type(header);
    info.type = type.type;
    info.big_endian = big_endian_samples(header, encoding, info.type);
    info.extent.rank = static_cast<int>(std::min<std::size_t>(3, sizes.size()));
    std::copy_n(sizes.begin(), info.extent.rank, info.extent.size.begin());
    if (encoding != Encoding::text && size_of(info.type) > 1 && header.first_of({"binarydatabyteordermsb", "elementbyteordermsb"}).empty())
        info.notes.push_back("byte order not given: little endian assumed");
    read_geometry(header, sizes.size(), info);
    set_calibration(info, header.number("elementtointensityfunctionslope", 1), header.number("elementtointensityfunctionoffset", 0));
    info.description = printable(header.text("comment"));
    const TimeStep step = choose_time_step(path, options, sizes.size() == 4 ? sizes[3] : 1);
    const PayloadPlan plan = payload_plan(header, encoding, type, sample_bytes(path, info.extent, info.type, step.count), options);
    if (plan.files.count() > 0) info.data_file = data_file_path(plan, 0);
    check_compressed_size(header, plan, info);
    std::unique_ptr<ByteSource> source = open_payload(plan);
    info.file_bytes = bytes_on_disk(plan);
    return make_sample_reader(std::move(info), std::move(source), options, step, type.wide);
}

}  // namespace isoatlas
