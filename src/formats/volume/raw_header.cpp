#include "formats/volume/raw_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/component_source.h"
#include "formats/volume/formats.h"
#include "formats/volume/key_lines.h"
#include "formats/volume/raw_description.h"
#include "formats/volume/sample_reader.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr std::array<std::string_view, 24> kDatKeys{
    "objectfilename", "taggedfilename", "rawfile",     "resolution", "dimensions", "slicethickness", "spacing",    "format",
    "nbrtags",        "objecttype",     "objectmodel", "gridtype",   "byteoffset", "littleendian",   "byteorder",  "basisvector1",
    "basisvector2",   "basisvector3",   "offset",      "valueunit",  "unit",       "datarange",      "valuerange", "modality"};
constexpr std::array<std::string_view, 2> kDatFiles{"objectfilename", "rawfile"}, kDatSizes{"resolution", "dimensions"};
constexpr std::int64_t kStartBytes = 4096;

/// "USHORT", "UCHAR4", "Vec3FLOAT32": the type and the number of components.
void read_dat_type(const KeyLines& lines, RawHeader& header) {
    std::string name = lower(lines.text("format"));
    if (name.empty()) lines.fail(ErrorKind::input, "Format", "is missing", "the type of the samples");
    const auto is_count = [](char c) { return c >= '2' && c <= '4'; };
    if (name.starts_with("vec") && name.size() > 4 && is_count(name[3])) {
        header.components = name[3] - '0';
        name = name.substr(4);
    }
    header.type = name == "char" ? ValueType::i8 : find_value_type(name);
    if (!header.type && is_count(name.back()) && header.components == 1) {
        header.components = name.back() - '0';
        name.pop_back();
        header.type = name == "char" ? ValueType::i8 : find_value_type(name);
    }
    if (!header.type) {
        lines.fail(ErrorKind::unsupported, "Format", "samples of type " + in_quotes(lines.text("format")) + " are not supported",
                   "UCHAR, USHORT, FLOAT, UINT8, INT16, FLOAT32, ...", "convert the samples, or correct the header");
    }
    if (header.components > 1) return;
    static constexpr std::array<std::pair<std::string_view, int>, 4> kModels{{{"la", 2}, {"rg", 2}, {"rgb", 3}, {"rgba", 4}}};
    for (const auto& [model, count] : kModels) {
        if (lower(lines.text("objectmodel")) == model) header.components = count;
    }
}

void read_dat_order(const KeyLines& lines, RawHeader& header) {
    const std::string little = lower(lines.text("littleendian")), order = lower(lines.text("byteorder"));
    if (little == "true" || little == "1" || order.starts_with("little")) {
        header.big_endian = false;
    } else if (little == "false" || little == "0" || order.starts_with("big")) {
        header.big_endian = true;
    } else if (!little.empty() || !order.empty()) {
        lines.fail(ErrorKind::input, little.empty() ? "ByteOrder" : "LittleEndian", "is not understood", "true or false, little or big");
    }
}

void read_dat_geometry(const KeyLines& lines, RawHeader& header) {
    const auto first_of = [&](std::string_view one, std::string_view other) { return lines.numbers(lines.has(one) ? one : other, 3); };
    if (const auto spacing = first_of("spacing", "slicethickness")) {
        header.steps = Mat3{};
        for (std::size_t axis = 0; axis < 3; ++axis) (*header.steps)[axis][axis] = (*spacing)[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {  // as long as the volume
        const auto side = lines.numbers("basisvector" + std::to_string(axis + 1), 3);
        if (!side) continue;
        if (!header.steps) header.steps = Mat3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        for (std::size_t row = 0; row < 3; ++row)
            (*header.steps)[axis][row] = (*side)[row] / static_cast<double>(std::max<std::int64_t>(header.sizes[axis], 1));
    }
    if (const auto corner = lines.numbers("offset", 3)) {
        for (std::size_t row = 0; row < 3; ++row) {
            header.origin[row] = (*corner)[row];
            for (std::size_t axis = 0; axis < 3 && header.steps; ++axis) header.origin[row] += (*header.steps)[axis][row] / 2;
        }
    }
}

std::string_view start_text(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

bool begins_like_dat(std::string_view text) { return has_key_line(text, kDatFiles) && has_key_line(text, kDatSizes); }

/// An XML document whose first element is that of MIPAV.
bool begins_like_mipav(std::string_view text) {
    text = trim(text);
    return text.starts_with("<?xml") && text.find("<image ") != std::string_view::npos &&
           text.find("nDimensions") != std::string_view::npos;
}

VolumeInfo describe(const std::string& path, const char* format, const RawHeader& header) {
    VolumeInfo info;
    info.path = path;
    info.format = format;
    info.encoding = "raw";
    info.type = *header.type;
    info.notes = header.notes;
    info.big_endian = header.big_endian.value_or(false) && size_of(info.type) > 1;
    if (!header.big_endian && size_of(info.type) > 1) info.notes.emplace_back("byte order not given: little endian assumed");
    std::ranges::copy(header.sizes, info.extent.size.begin());
    info.extent.rank = info.extent.size[2] == 1 ? 2 : 3;
    info.description = header.description;
    info.value_unit = header.value_unit;
    info.geometry.unit = header.unit;
    if (header.steps) {
        for (int axis = 0; axis < 3; ++axis) set_axis_step(info, axis, (*header.steps)[static_cast<std::size_t>(axis)]);
        require_frame(info);
    }
    info.geometry.origin = header.origin;
    for (const double place : info.geometry.origin) {
        if (!std::isfinite(place)) bad_header(path, "origin", "the first sample is not at a finite position", "smaller numbers");
    }
    return info;
}

}  // namespace

RawHeader read_dat_header(const std::string& path) {
    const KeyLines lines(path, kDatKeys);
    RawHeader header;
    for (const std::string_view key : kDatFiles) {
        if (header.files.empty()) header.files = lines.all(key);
    }
    if (header.files.empty() || header.files[0].empty())
        lines.fail(ErrorKind::input, "ObjectFileName", "is missing", "the name of the file with the samples");
    header.time_steps = static_cast<std::int64_t>(header.files.size());
    for (const std::string_view key : kDatSizes) {
        if (const auto sizes = lines.integers(key, 3); sizes && header.sizes.empty()) header.sizes = *sizes;
    }
    if (header.sizes.empty()) lines.fail(ErrorKind::input, "Resolution", "is missing", "three sizes");
    const std::string grid = lower(lines.text("gridtype"));
    constexpr std::array<std::string_view, 6> kGrids{"", "equidistant", "uniform", "cartesian", "regular", "---"};
    if (std::ranges::find(kGrids, grid) == kGrids.end())
        lines.fail(ErrorKind::unsupported, "GridType", in_quotes(grid) + " is not supported", "EQUIDISTANT", "resample it to an even grid");
    read_dat_type(lines, header);
    read_dat_order(lines, header);
    read_dat_geometry(lines, header);
    header.offset = lines.offset("byteoffset");
    header.value_unit = lines.text(lines.has("valueunit") ? "valueunit" : "unit");
    return header;
}

std::optional<std::string> find_raw_header(const std::string& path) {
    const std::filesystem::path file(path);
    for (const char* extension : {".dat", ".xml"}) {
        for (const std::string& candidate : {std::filesystem::path(file).replace_extension(extension).string(), path + extension}) {
            if (candidate == path || !file_exists(candidate)) continue;
            const std::vector<std::byte> start = read_header_bytes(candidate, kStartBytes);
            const bool is_dat = begins_like_dat(start_text(start));
            if (!is_dat && !begins_like_mipav(start_text(start))) continue;
            const RawHeader header = is_dat ? read_dat_header(candidate) : read_mipav_header(candidate);
            if (header.files.size() == 1 && header.files[0] == file.filename().string()) return candidate;
        }
    }
    return std::nullopt;
}

bool looks_like_raw_header(FirstBytes first, const std::string&) {
    const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
    return begins_like_dat(text) || begins_like_mipav(text);
}

std::unique_ptr<VolumeReader> open_raw_header(const std::string& path, const OpenOptions& options) {
    const std::vector<std::byte> start = read_header_bytes(path, kStartBytes);
    const bool is_dat = begins_like_dat(start_text(start));
    const RawHeader header = is_dat ? read_dat_header(path) : read_mipav_header(path);
    VolumeInfo info = describe(path, is_dat ? "RAW with .dat" : "RAW with .xml", header);
    if (info.extent.rank == 2) info.notes.emplace_back("there is a single slice along z: read as a 2D image");
    constexpr std::int64_t kMaxSteps = std::int64_t{1} << 40;
    if (header.time_steps < 1 || header.time_steps > kMaxSteps)
        bad_header(path, "time steps", std::to_string(header.time_steps) + " of them", "at least 1");
    const TimeStep step = choose_time_step(path, options, header.time_steps);
    PayloadPlan plan;
    plan.header_path = path;
    plan.files.names = header.files;
    plan.skip = header.offset;
    plan.type = info.type;
    plan.sample_bytes = sample_bytes(path, info.extent, info.type, 1);
    const auto multiply = [&](std::int64_t factor) {
        if (plan.sample_bytes > std::numeric_limits<std::int64_t>::max() / factor)
            bad_header(path, "sizes", "do not fit in 63 bits", "smaller sizes");
        plan.sample_bytes *= factor;
    };
    multiply(header.time_steps);
    multiply(header.components);
    plan.skip_rest = options.skip_rest;
    plan.follow_links = options.follow_links;
    std::int64_t component = 0;
    if (header.components > 1) {
        info.volumes.channels.resize(static_cast<std::size_t>(header.components));
        info.volumes.channel = component = choose_channel(path, options, info.volumes.channels);
    }
    info.data_file = data_file_path(plan, header.files.size() > 1 ? step.index : 0);
    std::unique_ptr<ByteSource> source = open_payload(plan);
    info.file_bytes = bytes_on_disk(plan);
    const auto sample = static_cast<std::int64_t>(size_of(info.type));
    return make_sample_reader(std::move(info), pick_component(std::move(source), sample, header.components, component), options, step);
}

}  // namespace isoatlas
