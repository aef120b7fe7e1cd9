// NIfTI-1 and NIfTI-2: .nii, .nii.gz and pairs .hdr + .img (each may be packed). ANALYZE 7.5, their predecessor: pairs.
#include "formats/volume/nifti_header.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/common/own_folder.h"
#include "formats/common/packed_file.h"
#include "formats/common/text.h"
#include "formats/volume/axes.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/formats.h"
#include "formats/volume/nifti_geometry.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {

namespace {

constexpr double kLargestOffset = 9.0e15;  ///< below 2^53: exact

[[noreturn]] void unsupported(const std::string& path, const std::string& what, const std::string& expected, const std::string& next) {
    throw Error(ErrorKind::unsupported, {.file = path, .where = "header", .what = what, .expected = expected, .next = next});
}

/// "brain.img.gz" -> "brain.hdr.gz": the other file of a pair, with the case of the letters kept. nullopt: not such a name.
std::optional<std::string> partner(const std::string& path, std::string_view from, std::string_view to) {
    std::string stem(unpacked_name(path));
    const std::string end = path.substr(stem.size());
    if (!ends_with_ignoring_case(stem, from)) return std::nullopt;
    const bool upper = stem.back() < 'a';
    stem.resize(stem.size() - to.size());
    for (const char c : to) stem += upper && c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
    return stem + end;
}

bool is_readable(const std::string& path) {
    try {
        (void)file_size(path);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// The partner, packed like this file, not at all or otherwise, whichever exists; the first choice when none does (opening it gives the
/// error).
std::string find_partner(const std::string& path, std::string_view from, std::string_view to) {
    std::string first = partner(path, from, to).value_or(path);
    const std::string stem(unpacked_name(first));
    for (const std::string& name : {first, stem, stem + ".gz", stem + ".bz2"}) {
        if (is_readable(name)) return name;
    }
    return first;
}

struct NiftiType {
    int code;
    ValueType type;
    WideInteger wide = WideInteger::none;
};

NiftiType value_type(const std::string& path, const NiftiHeader& header) {
    static constexpr NiftiType kKnown[] = {{2, ValueType::u8},
                                           {4, ValueType::i16},
                                           {8, ValueType::i32},
                                           {16, ValueType::f32},
                                           {64, ValueType::f64},
                                           {256, ValueType::i8},
                                           {512, ValueType::u16},
                                           {768, ValueType::u32},
                                           {1024, ValueType::f64, WideInteger::int64},
                                           {1280, ValueType::f64, WideInteger::uint64}};
    struct Other {
        int code;
        const char* name;
        const char* next = "convert it, e.g. in Python: nibabel.Nifti1Image(data.astype('float32'), image.affine)";
    };
    static constexpr const char* kOneColour =
        "save one of them, e.g. in Python: nibabel.Nifti1Image(image.dataobj[...]['R'], image.affine)";
    static constexpr Other kOther[] = {
        {1, "single bits"},        {32, "complex numbers"},   {128, "RGB colours", kOneColour},  {1536, "128-bit floating point numbers"},
        {1792, "complex numbers"}, {2048, "complex numbers"}, {2304, "RGBA colours", kOneColour}};
    for (const NiftiType& known : kKnown) {
        if (known.code != header.datatype) continue;
        if (header.bits != 0 && header.bits != static_cast<int>(8 * size_of(known.type))) {
            bad_header(path, "bitpix", "datatype " + std::to_string(header.datatype) + " with " + std::to_string(header.bits) + " bits",
                       std::to_string(8 * size_of(known.type)));
        }
        return known;
    }
    for (const Other& other : kOther) {
        if (other.code == header.datatype) {
            unsupported(path, std::string("samples are ") + other.name, "8 to 64-bit integers, 32 or 64-bit floating point", other.next);
        }
    }
    bad_header(path, "datatype", "unknown code " + std::to_string(header.datatype), "2, 4, 8, 16, 64, 256, 512, 768, 1024 or 1280");
}

struct Shape {
    Extent extent;
    std::int64_t volumes = 1;
};

Shape read_shape(const std::string& path, const NiftiHeader& header) {
    const std::int64_t dimensions = header.dim[0];
    if (dimensions < 1 || dimensions > 7) bad_header(path, "dim[0]", std::to_string(dimensions) + " dimensions", "2 to 7");
    if (dimensions == 1)
        unsupported(path, "the file has one dimension", "2 or 3 (4 with a time step)", "reshape it to the size of the image");
    for (std::int64_t i = 1; i <= dimensions; ++i) {
        const std::int64_t size = header.dim[static_cast<std::size_t>(i)];
        if (size < 1) bad_header(path, "dim[" + std::to_string(i) + "]", "an axis has " + std::to_string(size) + " samples", "at least 1");
        if (i > 4 && size > 1) {
            unsupported(path,
                        "dimension " + std::to_string(i) + " has " + std::to_string(size) + " values (vectors or more than 4 dimensions)",
                        "one value per voxel", "save one component as a file, e.g. in Python: nibabel, image.dataobj[..., 0]");
        }
    }
    Shape shape;
    shape.extent = {.rank = dimensions == 2 ? 2 : 3, .size = {header.dim[1], header.dim[2], dimensions > 2 ? header.dim[3] : 1}};
    shape.volumes = dimensions > 3 ? header.dim[4] : 1;
    return shape;
}

std::int64_t data_offset(const std::string& path, const NiftiHeader& header, std::vector<std::string>& notes) {
    const double offset = header.vox_offset;
    if (!std::isfinite(offset) || offset < 0 || offset > kLargestOffset || offset != std::floor(offset)) {
        bad_header(path, "vox_offset", "the samples start at byte " + std::to_string(offset), "a position in the file");
    }
    const std::int64_t header_size = header.version == 1 ? kNifti1HeaderBytes : kNifti2HeaderBytes;
    if (!header.pair && offset == 0) {
        notes.emplace_back("the header does not say where the samples start: assumed directly after it");
        return header_size + 4;
    }
    if (!header.pair && offset < static_cast<double>(header_size)) {
        bad_header(path, "vox_offset", "the samples start inside the header, at byte " + std::to_string(static_cast<std::int64_t>(offset)),
                   std::to_string(header_size + 4) + " or more");
    }
    return static_cast<std::int64_t>(offset);
}

NiftiHeader read_nifti_header(const std::string& path) {
    const std::vector<std::byte> bytes = read_unpacked_bytes(path, kNifti2HeaderBytes);
    const NiftiKind kind = nifti_kind(bytes);
    const std::int64_t size = kind == NiftiKind::nifti2 ? kNifti2HeaderBytes : kNifti1HeaderBytes;
    if (static_cast<std::int64_t>(bytes.size()) < size) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "header",
                                       .what = "the file ends after " + std::to_string(bytes.size()) + " bytes",
                                       .expected = std::to_string(size) + " bytes of header",
                                       .next = "the file is truncated: get it again"});
    }
    if (kind == NiftiKind::no) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "header",
                                       .what = "is not a NIfTI file",
                                       .expected = "the size 348 or 540 and the mark 'n+1' or 'n+2'",
                                       .next = "check the file, or give it the extension of its real format"});
    }
    return decode_nifti(bytes, kind);
}

/// What readers agree upon (SPM, nibabel); files of other programs may leave these fields to chance.
void complete_analyze(const NiftiHeader& header, VolumeInfo& info) {
    info.geometry.unit = header.analyze_unit;
    info.notes.emplace_back("ANALYZE 7.5 does not say which side is left, nor where the volume lies");
    if (!info.calibration.is_linear_identity()) info.notes.emplace_back("the scale factor of SPM was applied");
}

/// The header beside an .img file, when there is one.
bool has_nifti_header(const std::string& image) {
    try {
        const NiftiKind kind = nifti_kind(read_unpacked_bytes(find_partner(image, ".img", ".hdr"), kNifti2HeaderBytes));
        return kind != NiftiKind::no;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

bool looks_like_nifti(FirstBytes first, const std::string& path) {
    const NiftiKind kind = nifti_kind(first);
    if (kind == NiftiKind::nifti1 || kind == NiftiKind::nifti2) return true;
    if (ends_with_ignoring_case(unpacked_name(path), ".nii")) return true;
    const bool is_header = partner(path, ".hdr", ".img").has_value();
    if (kind == NiftiKind::analyze) return is_header;
    return partner(path, ".img", ".hdr").has_value() && has_nifti_header(path);
}

std::unique_ptr<VolumeReader> open_nifti(const std::string& path, const OpenOptions& options) {
    const std::string header_path = partner(path, ".img", ".hdr") ? find_partner(path, ".img", ".hdr") : path;
    const NiftiHeader header = read_nifti_header(header_path);
    const std::string data_path = !header.pair ? header_path : header_path == path ? find_partner(path, ".hdr", ".img") : path;
    if (!options.follow_links && data_path != header_path) require_own_folder(path, data_path == path ? header_path : data_path);
    if (header.pair && data_path == header_path) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "header",
                                       .what = "declares its samples in a second file",
                                       .expected = "a pair NAME.hdr and NAME.img",
                                       .next = "rename the header to .hdr and put the .img beside it"});
    }
    VolumeInfo info;
    info.path = path;
    info.format = header.is_analyze ? "ANALYZE 7.5" : header.version == 1 ? "NIfTI-1" : "NIfTI-2";
    info.encoding = name_of(packing_of(data_path));
    if (data_path != path) info.data_file = data_path;
    const NiftiType type = value_type(header_path, header);
    info.type = type.type;
    info.big_endian = header.big_endian;
    const Shape shape = read_shape(header_path, header);
    info.extent = shape.extent;
    const TimeStep step = choose_time_step(path, options, shape.volumes);
    info.geometry = nifti_geometry(header, shape.extent.rank, info.notes);
    if (header.slope != 0) set_calibration(info, header.slope, header.intercept);  // 0: no scaling
    if (header.is_analyze) complete_analyze(header, info);
    info.description = header.description;
    info.file_bytes = file_size(header_path) + (data_path == header_path ? 0 : file_size(data_path));
    const std::int64_t offset = data_offset(header_path, header, info.notes);
    return make_sample_reader(std::move(info), open_unpacked(data_path, offset), options, step, type.wide);
}

}  // namespace isoatlas
