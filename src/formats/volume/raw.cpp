// RAW: samples without a header. Their description comes from the options, from a JSON sidecar and from the file name, in this order (see
// raw_description.h); options about the samples that contradict the sidecar are an error, both override the name. Without a sidecar a
// header beside it that names it is read instead (raw_header.h).
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
#include "formats/volume/raw_header.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

template <class T>
void take(const std::string& path, const char* member, const std::optional<T>& given, std::optional<T>& known) {
    if (given && known && *given != *known) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = std::string("the option ") + member + " contradicts the sidecar of the file",
                                       .next = std::string("leave ") + member + " out or correct the sidecar",
                                       .reason = Reason::contradicts_sidecar,
                                       .value = member});
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
                                   .what = "the spacing has an axis whose samples are no distance apart",
                                   .expected = "numbers other than 0",
                                   .next = "correct the spacing, or omit it",
                                   .reason = Reason::zero_spacing});
}

RawDescription collect(const std::string& path, const OpenOptions& options) {
    RawDescription known;
    if (const std::optional<std::string> sidecar = find_sidecar(path)) {
        if (!options.follow_links) require_own_folder(path, *sidecar);
        known = read_sidecar(*sidecar);
    }
    if (options.spacing) check_spacing(path, *options.spacing);
    take(path, "dims", options.dims, known.dims);
    take(path, "type", options.type, known.type);
    take(path, "big_endian", options.big_endian, known.big_endian);
    take(path, "skip_bytes", options.skip_bytes, known.skip_bytes);
    if (!known.spacing) known.spacing = options.spacing;  // a sidecar is corrected in open_volume(), with a note
    if (!known.origin) known.origin = options.origin;
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
    const std::string header = header_beside(path), sidecar = std::filesystem::path(path).filename().string() + ".json";
    const char* missing = known.dims ? "its type is not known" : known.type ? "its dims are not known" : "its dims and type are not known";
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = std::string("a RAW file has no header: ") + missing,
                                   .expected = "the sizes and the type of its samples",
                                   .next = header.empty() ? "give the sizes and the type of the samples, or write them into " + sidecar +
                                                                ", or name the file like name_64x64x64_uint8.raw"
                                                          : "open " + header + " instead, which describes it",
                                   .reason = header.empty() ? Reason::raw_layout_unknown : Reason::raw_has_header,
                                   .value = header.empty() ? sidecar : header});
}

struct Suggestion {
    Reason reason;
    std::string next, value{};
};

/// What fits the size of the file: other types for the same dims, another last size for the same type, or a header to skip.
Suggestion what_fits(const Extent& extent, ValueType type, std::int64_t skip, std::int64_t holds) {
    const std::int64_t voxels = extent.voxels(), sample = static_cast<std::int64_t>(size_of(type));
    if (holds >= voxels && holds % voxels == 0) {
        const std::int64_t bytes = holds / voxels;
        const std::array<const char*, 9> names = {"", "uint8 or int8", "uint16 or int16", "", "uint32, int32 or float32", "", "",
                                                  "", "float64"};
        if (bytes <= 8 && names[bytes][0] != '\0')
            return {Reason::raw_type_differs, std::string("the size fits these dims with type ") + names[bytes], names[bytes]};
    }
    const int last = extent.rank - 1;
    const std::int64_t layer = voxels / extent.size[last] * sample;
    if (layer > 0 && holds > 0 && holds % layer == 0) {
        const std::string size = std::to_string(holds / layer);
        return {Reason::raw_last_size_differs, "the size fits a last dimension of " + size + " with this type", size};
    }
    if (holds > voxels * sample) {
        const std::string header = std::to_string(skip + holds - voxels * sample);
        return {Reason::raw_has_more,
                "if the file begins with a header, skip " + header + " bytes; if something follows the samples, let the rest be skipped",
                header};
    }
    const std::int64_t samples = holds / sample;
    const auto edge = static_cast<std::int64_t>(std::llround(std::cbrt(static_cast<double>(samples))));
    if (edge > 0 && edge * edge * edge * sample == holds) {
        const std::string text = std::to_string(edge), sizes = text + "x" + text + "x" + text;
        return {Reason::raw_sizes_differ, "the size fits dims " + sizes + " with this type", sizes};
    }
    return {Reason::raw_size_differs, "check dims, type and the bytes to skip"};
}

Extent extent_of(const std::string& path, const std::vector<std::int64_t>& dims) {
    if (dims.size() < 2 || dims.size() > 3) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = std::to_string(dims.size()) + " sizes are given",
                                       .expected = "2 or 3",
                                       .next = "give NXxNY or NXxNYxNZ",
                                       .reason = Reason::wrong_dimension});
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
                                       .next = "correct the number of bytes to skip",
                                       .reason = Reason::skip_exceeds_file});
    }
    const std::int64_t holds = file_bytes - skip;
    if (holds == wanted || (holds > wanted && skip_rest)) return;
    const Suggestion fits = what_fits(extent, type, skip, holds);
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the file holds " + std::to_string(holds) + " bytes of samples",
                                   .expected = std::to_string(wanted) + " for these dims and " + name_of(type),
                                   .next = fits.next,
                                   .reason = fits.reason,
                                   .value = fits.value});
}

}  // namespace

std::unique_ptr<VolumeReader> open_raw(const std::string& path, const OpenOptions& options) {
    const std::int64_t file_bytes = file_size(path);
    if (!(options.dims && options.type) && !find_sidecar(path)) {
        if (const std::optional<std::string> header = find_raw_header(path)) {
            if (!options.follow_links) require_own_folder(path, *header);
            return open_raw_header(*header, options);
        }
    }
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
    info.geometry.unit = known.unit.empty() ? options.unit.value_or("") : known.unit;
    info.value_unit = known.value_unit.empty() ? options.value_unit.value_or("") : known.value_unit;
    const TimeStep step = choose_time_step(path, options, 1);
    return make_sample_reader(std::move(info), open_file_source(path, skip), options, step);
}

}  // namespace isoatlas
