// BOV, brick of values (VisIt): a text header (.bov) of "KEY: value" lines and a file of samples beside it, raw or in gzip.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/component_source.h"
#include "formats/volume/data_files.h"
#include "formats/volume/formats.h"
#include "formats/volume/key_lines.h"
#include "formats/volume/named_type.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr std::array<std::string_view, 13> kBovKeys{"data_file",    "data_size",      "data_format",    "data_endian", "byte_offset",
                                                    "brick_origin", "brick_size",     "centering",      "variable",    "time",
                                                    "divide_brick", "data_bricklets", "data_components"};

ValueType type_of_bov(const KeyLines& header) {
    static constexpr NamedType kTypes[] = {{"byte", ValueType::u8},     {"short", ValueType::i16},  {"int", ValueType::i32},
                                           {"integer", ValueType::i32}, {"float", ValueType::f32},  {"real", ValueType::f32},
                                           {"double", ValueType::f64},  {"doubles", ValueType::f64}};
    std::string name = lower(header.text("data_format"));
    if (name.empty()) name = "byte";  // as in VisIt
    for (const std::string& spelling : {name, name.ends_with('s') ? name.substr(0, name.size() - 1) : name}) {
        if (const std::optional<ValueType> type = find_type(kTypes, spelling)) return *type;
    }
    header.fail(ErrorKind::unsupported, "DATA_FORMAT", in_quotes(header.text("data_format")) + " samples are not supported",
                "BYTE, SHORT, INT, FLOAT or DOUBLE", "convert the file, or correct the header");
}

bool is_big_endian_bov(const KeyLines& header, VolumeInfo& info) {
    const std::string endian = lower(header.text("data_endian"));
    if (endian == "big") return size_of(info.type) > 1;
    if (endian == "little") return false;
    if (!endian.empty()) header.fail(ErrorKind::input, "DATA_ENDIAN", in_quotes(endian) + " is not a byte order", "LITTLE or BIG");
    if (size_of(info.type) > 1) info.notes.emplace_back("byte order not given: little endian assumed");
    return false;
}

bool is_zonal(const KeyLines& header) {
    const std::string centering = lower(header.text("centering"));
    if (centering.empty() || centering == "nodal") return false;  // as in VisIt
    if (centering == "zonal") return true;
    header.fail(ErrorKind::input, "CENTERING", in_quotes(centering) + " is not a centering", "nodal or zonal");
}

void read_bov_geometry(const KeyLines& header, VolumeInfo& info) {
    const std::vector<double> origin = header.numbers("brick_origin", 3).value_or(std::vector<double>{0, 0, 0});
    const std::optional<std::vector<double>> size = header.numbers("brick_size", 3);
    const bool zonal = is_zonal(header);
    if (!size) info.notes.emplace_back("the header has no BRICK_SIZE: distances of 1 were assumed");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t samples = info.extent.size[axis], steps = zonal ? samples : std::max<std::int64_t>(samples - 1, 1);
        if (size && (samples > 1 || (*size)[axis] != 0))
            set_axis_spacing(info, static_cast<int>(axis), (*size)[axis] / static_cast<double>(steps));
        const double step = info.geometry.direction[axis][axis] * info.geometry.spacing[axis];
        info.geometry.origin[axis] = origin[axis] + (zonal && samples > 1 ? step / 2 : 0);
        if (!std::isfinite(info.geometry.origin[axis]))
            header.fail(ErrorKind::input, "BRICK_ORIGIN", "the first sample is not at a finite position", "smaller numbers");
    }
}

PayloadPlan plan_of_bov(const KeyLines& header, const OpenOptions& options) {
    const std::string file = header.text("data_file");
    if (file.empty()) header.fail(ErrorKind::input, "DATA_FILE", "is missing", "the name of the file with the samples");
    if (file.find('%') != std::string::npos) {
        header.fail(ErrorKind::unsupported, "DATA_FILE", in_quotes(file) + " stands for several files of one brick each",
                    "one file with all samples", "save the volume as one brick, for example in VisIt: export it as VTK");
    }
    PayloadPlan plan;
    plan.header_path = header.path();
    plan.files.names = {file};
    plan.encoding = ends_with_ignoring_case(file, ".gz") ? Encoding::deflate : Encoding::raw;
    (plan.encoding == Encoding::raw ? plan.skip : plan.inflated_skip) = header.offset("byte_offset");
    plan.skip_rest = options.skip_rest;
    plan.follow_links = options.follow_links;
    return plan;
}

std::int64_t components_of(const KeyLines& header) {
    constexpr std::int64_t kMaxComponents = 1 << 16;
    if (lower(header.text("data_components")) == "complex") return 2;
    const std::int64_t count = header.integers("data_components", 1).value_or(std::vector<std::int64_t>{1})[0];
    if (count < 1 || count > kMaxComponents) header.fail(ErrorKind::input, "DATA_COMPONENTS", "is " + std::to_string(count), "1 or more");
    return count;
}

Extent extent_of_bov(const KeyLines& header, std::vector<std::string>& notes) {
    const std::optional<std::vector<std::int64_t>> sizes = header.integers("data_size", 3);
    if (!sizes) header.fail(ErrorKind::input, "DATA_SIZE", "is missing", "three sizes");
    Extent extent;
    std::ranges::copy(*sizes, extent.size.begin());
    extent.rank = extent.size[2] == 1 ? 2 : 3;
    if (extent.rank == 2) notes.emplace_back("the brick has a single slice along z: read as a 2D image");
    return extent;
}

}  // namespace

bool looks_like_bov(FirstBytes first, const std::string&) {
    const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
    static constexpr std::array<std::string_view, 1> kFile{"data_file"}, kSize{"data_size"};
    return has_key_line(text, kFile) && has_key_line(text, kSize);
}

std::unique_ptr<VolumeReader> open_bov(const std::string& path, const OpenOptions& options) {
    const KeyLines header(path, kBovKeys);
    VolumeInfo info;
    info.path = path;
    info.format = "BOV";
    info.description = header.text("variable");
    info.extent = extent_of_bov(header, info.notes);
    info.type = type_of_bov(header);
    info.big_endian = is_big_endian_bov(header, info);
    const std::int64_t components = components_of(header);
    PayloadPlan plan = plan_of_bov(header, options);
    plan.type = info.type;
    plan.sample_bytes = sample_bytes(path, info.extent, info.type, components);
    const TimeStep step = choose_time_step(path, options, 1);
    read_bov_geometry(header, info);
    if (const auto time = header.numbers("time", 1)) info.volumes.times = *time;
    std::int64_t component = 0;
    if (components > 1) {
        info.volumes.channels.resize(static_cast<std::size_t>(components));
        info.volumes.channel = component = choose_channel(path, options, info.volumes.channels);
    }
    info.encoding = plan.encoding == Encoding::raw ? "raw" : "gzip";
    info.data_file = data_file_path(plan, 0);
    std::unique_ptr<ByteSource> source = open_payload(plan);
    info.file_bytes = bytes_on_disk(plan);
    return make_sample_reader(std::move(info),
                              pick_component(std::move(source), static_cast<std::int64_t>(size_of(plan.type)), components, component),
                              options, step);
}

}  // namespace isoatlas
