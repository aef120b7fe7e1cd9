// RAW: samples without a header. Their description comes from the options, from a JSON sidecar and from the file name, in this order (see
// raw_description.h); options that contradict the sidecar are an error, both override the name.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/own_folder.h"
#include "formats/volume/axes.h"
#include "formats/volume/formats.h"
#include "formats/volume/raw_description.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

template <class T>
void take(const std::string& path, const char* option, const std::optional<T>& given, std::optional<T>& known) {
    if (given && known && *given != *known) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = std::string(option) + " contradicts the sidecar of the file",
                                       .next = std::string("leave ") + option + " out or correct the sidecar"});
    }
    if (given) known = given;
}

template <class T>
void guess(const std::optional<T>& from_name, std::optional<T>& known, const char* what, std::vector<std::string>& notes) {
    if (known || !from_name) return;
    known = from_name;
    notes.push_back(std::string(what) + " taken from the file name");
}

/// A zero spacing in a file becomes 1, with a note; in an option it is an error.
void check_spacing(const std::string& path, const Vec3& spacing) {
    if (std::all_of(spacing.begin(), spacing.end(), [](double length) { return std::isfinite(length) && length != 0; })) return;
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = "--spacing has an axis whose samples are no distance apart",
                                   .expected = "numbers other than 0",
                                   .next = "correct --spacing, or omit it"});
}

RawDescription collect(const std::string& path, const OpenOptions& options) {
    RawDescription known;
    if (const std::optional<std::string> sidecar = find_sidecar(path)) {
        if (!options.follow_links) require_own_folder(path, *sidecar);
        known = read_sidecar(*sidecar);
    }
    if (options.spacing) check_spacing(path, *options.spacing);
    take(path, "--dims", options.dims, known.dims);
    take(path, "--type", options.type, known.type);
    take(path, "--endian", options.big_endian, known.big_endian);
    take(path, "--skip", options.skip_bytes, known.skip_bytes);
    take(path, "--spacing", options.spacing, known.spacing);
    take(path, "--origin", options.origin, known.origin);
    const RawDescription name = description_from_name(path);
    guess(name.dims, known.dims, "dims", known.notes);
    guess(name.type, known.type, "type", known.notes);
    guess(name.big_endian, known.big_endian, "byte order", known.notes);
    return known;
}

/// A header file beside the RAW file that describes it: foo.mhd or foo.nhdr.
std::string header_beside(const std::string& path) {
    for (const char* extension : {".mhd", ".nhdr"}) {
        const std::string candidate = std::filesystem::path(path).replace_extension(extension).string();
        if (file_exists(candidate)) return candidate;
    }
    return {};
}

[[noreturn]] void unknown_shape(const std::string& path, const RawDescription& known) {
    const std::string header = header_beside(path);
    const char* missing = known.dims ? "its type is not known" : known.type ? "its dims are not known" : "its dims and type are not known";
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = std::string("a RAW file has no header: ") + missing,
                                   .expected = "Raw files need --dims and --type",
                                   .next = header.empty() ? "give --dims NXxNYxNZ --type TYPE, or write them into " +
                                                                std::filesystem::path(path).filename().string() +
                                                                ".json, or name the file like "
                                                                "name_64x64x64_uint8.raw"
                                                          : "open " + header + " instead, which describes it"});
}

/// Suggestions that fit the size of the file: other types for the same dims, another last size for the same type, or a header to skip.
std::string what_fits(const Extent& extent, ValueType type, std::int64_t skip, std::int64_t holds) {
    const std::int64_t voxels = extent.voxels(), sample = static_cast<std::int64_t>(size_of(type));
    if (holds >= voxels && holds % voxels == 0) {
        const std::int64_t bytes = holds / voxels;
        const std::array<const char*, 9> names = {"", "uint8 or int8", "uint16 or int16", "", "uint32, int32 or float32", "", "",
                                                  "", "float64"};
        if (bytes <= 8 && names[bytes][0] != '\0') return std::string("the size fits these dims with --type ") + names[bytes];
    }
    const int last = extent.rank - 1;
    const std::int64_t layer = voxels / extent.size[last] * sample;
    if (layer > 0 && holds > 0 && holds % layer == 0) {
        return "the size fits a last dimension of " + std::to_string(holds / layer) + " with this type";
    }
    if (holds > voxels * sample) {
        return "if the file begins with a header, add --skip " + std::to_string(skip + holds - voxels * sample) +
               "; if something follows the samples, pass --skip-rest";
    }
    const std::int64_t samples = holds / sample;
    const auto edge = static_cast<std::int64_t>(std::llround(std::cbrt(static_cast<double>(samples))));
    if (edge > 0 && edge * edge * edge * sample == holds) {
        const std::string text = std::to_string(edge);
        return "the size fits --dims " + text + "x" + text + "x" + text + " with this type";
    }
    return "check --dims, --type and --skip";
}

Extent extent_of(const std::string& path, const std::vector<std::int64_t>& dims) {
    if (dims.size() < 2 || dims.size() > 3) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "--dims has " + std::to_string(dims.size()) + " sizes",
                                       .expected = "2 or 3",
                                       .next = "give --dims NXxNY or NXxNYxNZ"});
    }
    Extent extent;
    extent.rank = static_cast<int>(dims.size());
    std::copy(dims.begin(), dims.end(), extent.size.begin());
    return extent;
}

void check_size(const std::string& path, const Extent& extent, ValueType type, std::int64_t skip, std::int64_t file_bytes, bool skip_rest) {
    const std::int64_t wanted = sample_bytes(path, extent, type);
    if (skip < 0 || skip > file_bytes) {
        throw Error(ErrorKind::input, {.file = path,
                                       .what = "cannot skip " + std::to_string(skip) + " bytes: the file has " + std::to_string(file_bytes),
                                       .expected = "0 to the size of the file",
                                       .next = "correct --skip"});
    }
    const std::int64_t holds = file_bytes - skip;
    if (holds == wanted || (holds > wanted && skip_rest)) return;
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the file holds " + std::to_string(holds) + " bytes of samples",
                                   .expected = std::to_string(wanted) + " for these dims and " + name_of(type),
                                   .next = what_fits(extent, type, skip, holds)});
}

}  // namespace

std::unique_ptr<VolumeReader> open_raw(const std::string& path, const OpenOptions& options) {
    const std::int64_t file_bytes = file_size(path);
    RawDescription known = collect(path, options);
    if (!known.dims || !known.type) unknown_shape(path, known);
    VolumeInfo info;
    info.path = path;
    info.format = "RAW";
    info.encoding = "raw";
    info.type = *known.type;
    info.extent = extent_of(path, *known.dims);
    info.big_endian = known.big_endian.value_or(false) && size_of(info.type) > 1;
    info.notes = std::move(known.notes);
    if (!known.big_endian && size_of(info.type) > 1) info.notes.push_back("byte order not given: little endian assumed");
    info.file_bytes = file_bytes;
    const std::int64_t skip = known.skip_bytes.value_or(0);
    check_size(path, info.extent, info.type, skip, file_bytes, options.skip_rest);
    for (int axis = 0; known.spacing && axis < info.extent.rank; ++axis) set_axis_spacing(info, axis, (*known.spacing)[axis]);
    if (known.origin) info.geometry.origin = *known.origin;
    if (!known.space.empty()) info.geometry.space = known.space;
    info.geometry.unit = known.unit;
    const TimeStep step = choose_time_step(path, options, 1);
    return make_sample_reader(std::move(info), open_file_source(path, skip), options, step);
}

}  // namespace isoatlas
