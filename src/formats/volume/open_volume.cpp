// open_volume: detects the format of a file by its content, and by its name where the content has no signature (RAW).
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "formats/common/file_access.h"
#include "formats/common/packed_file.h"
#include "formats/common/text.h"
#include "formats/volume/choose.h"
#include "formats/volume/formats.h"
#include "formats/volume/raw_description.h"
#include "isoatlas/dataset_path.h"
#include "isoatlas/text.h"
#include "isoatlas/units.h"
#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kFirstBytes = 4096;
constexpr const char* kSupported =
    "NRRD (.nrrd .nhdr), MetaImage (.mha .mhd), NIfTI-1 (.nii .nii.gz), NumPy (.npy), VTK image (.vti .vtk), TIFF (.tif), PNG, JPEG, BMP, "
    "MRC (.mrc .map .map.gz), "
    "DICOM, HDF5 (.h5 .ims .vtkhdf), NetCDF (.nc), Amira (.am), OpenVDB (.vdb), BOV (.bov), OME-Zarr and Zarr (a folder, or .zip), a "
    "folder of slices, RAW "
    "(also by its .dat or .xml)";

struct ReadFormat {
    const char* name;
    const char* extensions;  ///< separated by blanks
    bool (*looks_like)(FirstBytes, const std::string&);
    std::unique_ptr<VolumeReader> (*open)(const std::string&, const OpenOptions&);
    bool may_be_packed = false;  ///< the whole file, by gzip or bzip2
};

constexpr std::array<ReadFormat, 19> kReadFormats = {
    {{"DICOM", ".dcm .dicom .ima", looks_like_dicom, open_dicom},  // its preamble may be a TIFF file
     {"NRRD", ".nrrd .nhdr", looks_like_nrrd, open_nrrd},
     {"NIfTI", ".nii", looks_like_nifti, open_nifti, true},
     {"NumPy", ".npy", looks_like_npy, open_npy},
     {"VTK image", ".vti", looks_like_vti, open_vti},
     {"VTK legacy", ".vtk", looks_like_vtk_legacy, open_vtk_legacy},
     {"TIFF", ".tif .tiff", looks_like_tiff, open_tiff},
     {"PNG", ".png", looks_like_png, open_picture},
     {"JPEG", ".jpg .jpeg", looks_like_jpeg, open_picture},
     {"BMP", ".bmp .dib", looks_like_bmp, open_picture},
     {"MRC", ".mrc .map .ccp4 .rec .st .ali .mrcs", looks_like_mrc, open_mrc, true},
     {"Amira", ".am .amiramesh", looks_like_amira, open_amira},
     {"OpenVDB", ".vdb", looks_like_vdb, open_vdb},
     {"Zarr", ".zip .ozx", looks_like_zip, open_zarr_zip},
     {"MetaImage", ".mha .mhd", looks_like_metaimage, open_metaimage},
     {"NetCDF", ".nc .nc4 .netcdf", looks_like_netcdf, open_netcdf},
     {"HDF5", ".h5 .hdf5 .he5 .ims .nxs .nx5 .vtkhdf .jld2", looks_like_hdf5, open_hdf5},
     {"BOV", ".bov", looks_like_bov, open_bov},
     {"a header of RAW files", "", looks_like_raw_header, open_raw_header}}};  // other files may have these names

/// Common formats that isoatlas does not read, and how to convert them.
constexpr std::array<std::pair<std::string_view, const char*>, 5> kForeign = {
    {{".hdr", "give the .nii or .mhd file of the pair; of an ANALYZE pair the .img file must be beside it"},
     {".img", "open it as RAW with the sizes and the type of its samples, or convert the pair to NIfTI"},
     {".mat", "save it with -v7.3, or export the array to .npy (scipy.io.loadmat and numpy.save)"},
     {".fits", "export the cube to .npy (astropy.io.fits and numpy.save)"},
     {".npz", "save the array by itself: numpy.save"}}};

bool has_extension(const std::string& path, const ReadFormat& format) {
    const std::vector<std::string_view> extensions = split_words(format.extensions);
    const std::string_view name = format.may_be_packed ? unpacked_name(path) : path;
    return std::any_of(extensions.begin(), extensions.end(), [&](std::string_view end) { return ends_with_ignoring_case(name, end); });
}

/// Suggests a file of the same folder with a similar name.
[[noreturn]] void missing_file(const std::string& path) {
    constexpr std::size_t kMaxEntries = 10000, kFarthest = 2;
    const std::filesystem::path whole(path);
    const std::string name = whole.filename().string();
    const std::string folder = whole.has_parent_path() ? whole.parent_path().string() : ".";
    std::string best;
    std::size_t best_distance = kFarthest + 1;
    for (const std::string& entry : directory_entries(folder, kMaxEntries)) {
        if (std::max(entry.size(), name.size()) - std::min(entry.size(), name.size()) > kFarthest) continue;
        const std::size_t distance = edit_distance(lower(name), lower(entry));
        if (distance < best_distance || (distance == best_distance && entry < best)) {
            best = entry;
            best_distance = distance;
        }
    }
    throw Error(ErrorKind::input,
                {.file = path,
                 .what = "there is no such file",
                 .next = best.empty() ? "check the path" : "did you mean " + (whole.parent_path() / best).string() + "?"});
}

[[noreturn]] void unknown_format(const std::string& path) {
    for (const ReadFormat& format : kReadFormats) {
        if (!has_extension(path, format)) continue;
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "first bytes",
                                       .what = std::string("the file is named like ") + format.name + " but does not begin like one",
                                       .next = "the file is damaged or misnamed: get it again"});
    }
    const std::string extension = lower(std::filesystem::path(path).extension().string());
    if (extension == ".atlas") {  // no signature is left
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "first bytes",
                                       .what = "the file is named like a store but does not begin like one",
                                       .next = "the file is damaged or misnamed: build it again from the volume"});
    }
    std::string next = "convert the file, or give the sizes and the type of its samples if it is RAW", nearest;
    Reason reason = extension == ".img" ? Reason::analyze_pair : Reason::unknown_format;
    for (const auto& [foreign, hint] : kForeign) {
        if (extension != foreign) continue;
        next = hint;
        if (reason == Reason::unknown_format) reason = Reason::foreign_format;
    }
    for (const ReadFormat& format : kReadFormats) {
        for (const std::string_view known : split_words(format.extensions)) {
            const bool is_guess = reason == Reason::unknown_format && extension.size() > 1;
            if (is_guess && edit_distance(extension, known) == 1) nearest = known;
        }
    }
    if (!nearest.empty()) next = "did you mean " + nearest + "? " + next;
    throw Error(ErrorKind::unsupported,
                {.file = path, .what = "unknown file format", .expected = kSupported, .next = next, .reason = reason, .value = nearest});
}

/// Throws Error{unsupported} when a file that begins with these bytes is packed in a way that is not read.
void refuse_packed(const std::string& path, FirstBytes first) {
    struct Archive {
        std::size_t at;
        std::string_view mark;
        const char *name, *next;
    };
    static constexpr std::array<Archive, 5> kArchives{{{0, "\3757zXZ", "xz", "unpack it with unxz"},
                                                       {0, "\x28\xb5\x2f\xfd", "zstd", "unpack it with unzstd"},
                                                       {0, "7z\xbc\xaf\x27\x1c", "7-Zip", "unpack it with 7z x"},
                                                       {0, "Rar!\x1a\x07", "RAR", "unpack it with unrar x"},
                                                       {257, "ustar", "tar", "unpack it with tar -xf, and give the file or folder in it"}}};
    const std::string_view text(reinterpret_cast<const char*>(first.data()), first.size());
    for (const Archive& archive : kArchives) {
        if (text.size() < archive.at || !text.substr(archive.at).starts_with(archive.mark)) continue;
        throw Error(ErrorKind::unsupported,
                    {.file = path, .what = std::string("is packed: ") + archive.name, .expected = "a volume", .next = archive.next});
    }
}

/// Whether the name exists, also when it cannot be read: then opening it gives the error.
bool anything_at(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::symlink_status(path, ignored).type() != std::filesystem::file_type::not_found;
}

/// RAW by its name, options or sidecar.
bool is_described_raw(const std::string& path, const OpenOptions& options) {
    if (ends_with_ignoring_case(path, ".raw")) return true;
    if (options.dims && options.type) return true;
    const RawDescription name = description_from_name(path);
    return (name.dims && name.type) || find_sidecar(path).has_value();
}

/// The bytes that formats inspect: of a packed file those of what is in it.
struct Start {
    std::vector<std::byte> bytes;
    FilePacking packing = FilePacking::none;
};

Start first_bytes(const std::string& path, bool may_be_raw) {
    Start start{.bytes = read_header_bytes(path, kFirstBytes)};
    const FilePacking packing = packing_of(start.bytes);
    if (packing == FilePacking::none) return start;
    try {
        start = {.bytes = read_unpacked_bytes(path, kFirstBytes), .packing = packing};
    } catch (const Error&) {
        if (!may_be_raw) throw;  // else samples that happen to begin like a packed file
    }
    return start;
}

std::unique_ptr<VolumeReader> open_file_volume(const std::string& path, const OpenOptions& options) {
    if (ends_with_ignoring_case(path, ".raw")) return open_raw(path, options);
    const bool described = is_described_raw(path, options);
    const Start start = first_bytes(path, described);
    if (start.bytes.empty()) {
        throw Error(ErrorKind::input, {.file = path, .what = "the file is empty", .expected = "a volume", .next = "get the file again"});
    }
    for (const ReadFormat& format : kReadFormats) {
        if (!format.looks_like(start.bytes, path)) continue;
        if (start.packing != FilePacking::none && !format.may_be_packed) {
            throw Error(ErrorKind::unsupported,
                        {.file = path,
                         .what = std::string("a whole ") + format.name + " file in " + name_of(start.packing) + " is not supported",
                         .next = start.packing == FilePacking::gzip ? "unpack it with gunzip" : "unpack it with bunzip2"});
        }
        return format.open(path, options);
    }
    if (described) return open_raw(path, options);
    refuse_packed(path, start.bytes);
    unknown_format(path);
}

[[noreturn]] void contradiction(const std::string& path, const std::string& member, const std::string& header) {
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = "the option " + member + " contradicts the header of the file",
                                   .expected = header,
                                   .next = "leave " + member + " out; it is for RAW files",
                                   .reason = Reason::contradicts_header,
                                   .value = member});
}

/// These options describe RAW files; for other files they may repeat the header but not contradict it.
void check_agreement(const VolumeInfo& info, const OpenOptions& options) {
    if (info.format == "RAW") return;
    const Extent& extent = info.extent;
    const std::vector<std::int64_t> dims(extent.size.begin(), extent.size.begin() + extent.rank);
    if (options.dims && *options.dims != dims) {
        std::string text = std::to_string(dims[0]);
        for (int axis = 1; axis < extent.rank; ++axis) text += "x" + std::to_string(dims[static_cast<std::size_t>(axis)]);
        contradiction(info.path, "dims", text);
    }
    if (options.type && *options.type != info.type) contradiction(info.path, "type", name_of(info.type));
    if (options.big_endian && *options.big_endian != info.big_endian && size_of(info.type) > 1) {
        contradiction(info.path, "big_endian", info.big_endian ? "big" : "little");
    }
    if (options.skip_bytes && *options.skip_bytes != 0) contradiction(info.path, "skip_bytes", "samples where the header says");
}

/// Formats with one channel, one level and one array of samples do not look at these options.
void check_choices(const VolumeInfo& info, const OpenOptions& options) {
    const FileVolumes& volumes = info.volumes;
    const std::vector<std::string> one{""};
    if (volumes.channels.empty() && options.channel) (void)choose_channel(info.path, options, one);
    if (volumes.levels.empty() && options.level) (void)choose_level(info.path, options, 1);
    const auto refuse = [&](const char* name, Reason reason) {
        throw Error(ErrorKind::usage,
                    {.file = info.path,
                     .what = std::string("a file of this format (") + info.format + ") has no " + name + " to choose from",
                     .next = std::string("leave the ") + name + " out",
                     .reason = reason});
    };
    if (options.dataset && !volumes.has_datasets) refuse("datasets", Reason::no_datasets);
    if (options.series && !volumes.has_series) refuse("series", Reason::no_series);
}

/// FILE:/DATASET as the file and OpenOptions::dataset.
std::pair<std::string, OpenOptions> without_dataset(const std::string& path, OpenOptions options) {
    if (options.dataset) return {path, options};
    const DatasetPath split = split_dataset(path);
    if (!split.dataset.empty()) options.dataset = split.dataset;
    return {split.file, options};
}

}  // namespace

std::unique_ptr<VolumeReader> open_volume(const std::string& given, const OpenOptions& given_options) {
    const auto [path, options] = without_dataset(given, given_options);
    const bool folder = is_directory(path);
    if (!folder && !is_address(path) && !anything_at(path)) missing_file(path);
    std::unique_ptr<VolumeReader> reader = !folder                ? open_file_volume(path, options)
                                           : is_zarr_folder(path) ? open_zarr_folder(path, options)
                                                                  : open_folder(path, options);
    check_choices(reader->info(), options);
    reader->info_.path = given;
    check_agreement(reader->info(), options);
    correct(reader->info_, {.spacing = options.spacing, .origin = options.origin, .unit = options.unit, .value_unit = options.value_unit});
    return options.box ? box_reader(std::move(reader), *options.box) : std::move(reader);
}

}  // namespace isoatlas
