// HDF5: arrays of any program, and files that follow a convention (hdf5_conventions.h). Samples are read chunk by chunk.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/formats.h"
#include "formats/volume/hdf5_conventions.h"
#include "formats/volume/netcdf_file.h"

namespace isoatlas {
namespace {

constexpr std::array<unsigned char, 8> kHdf5Signature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
constexpr std::string_view kStoreSignature{"isoatlas store\n\0", 16};

bool is_hdf5_signature(std::span<const std::byte> bytes) {
    return bytes.size() >= kHdf5Signature.size() && std::memcmp(bytes.data(), kHdf5Signature.data(), kHdf5Signature.size()) == 0;
}

bool begins_as(FirstBytes first, std::string_view text) {
    return first.size() >= text.size() && std::memcmp(first.data(), text.data(), text.size()) == 0;
}

}  // namespace

VolumeInfo Hdf5Request::info(const char* format) const {
    VolumeInfo info;
    info.path = path();
    info.format = format;
    info.file_bytes = file_size(path());
    return info;
}

std::string shape_of(const Hdf5Array& array) {
    std::string text;
    for (std::size_t d = array.dims.size(); d-- > 0;) text += std::to_string(array.dims[d]) + (d > 0 ? " x " : " ");
    return text + array.type.name;
}

Index3 size_of_volume(const Hdf5Array& array) {
    Index3 size{1, 1, 1};
    for (std::size_t a = 0; a < std::min<std::size_t>(array.dims.size(), 3); ++a) size[a] = array.dims[array.dims.size() - 1 - a];
    return size;
}

std::optional<std::int64_t> number_behind(const std::string& name, const std::string& beginning) {
    if (!name.starts_with(beginning)) return std::nullopt;
    const std::string digits = name.substr(beginning.size());
    if (digits.empty() || !std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; })) return std::nullopt;
    return parse_integer(digits);
}

bool are_numbers(const std::vector<double>& numbers, std::size_t count) {
    return numbers.size() == count && std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

bool looks_like_hdf5(FirstBytes first, const std::string& path) {
    if (begins_as(first, kStoreSignature) || ends_with_ignoring_case(path, ".atlas")) return false;  // a store has its own reader
    for (std::size_t at = 0; at < first.size(); at = at == 0 ? 512 : 2 * at) {
        if (is_hdf5_signature(first.subspan(at))) return true;
    }
    try {  // behind a longer user block, at powers of two
        const std::unique_ptr<File> file = open_file(path);
        std::array<std::byte, 8> bytes{};
        for (std::int64_t at = 4096; at <= file->size() - static_cast<std::int64_t>(bytes.size()); at *= 2) {
            read_fully(*file, path, at, bytes);
            if (is_hdf5_signature(bytes)) return true;
        }
    } catch (const Error&) {
    }
    return false;
}

std::unique_ptr<VolumeReader> open_hdf5(const std::string& path, const OpenOptions& options) {
    const Hdf5Request request{std::make_shared<const Hdf5File>(path, options.follow_links), options};
    for (const auto open_by : {open_imaris, open_big_data_viewer, open_openpmd, open_vtkhdf_image}) {
        if (std::unique_ptr<VolumeReader> reader = open_by(request)) return reader;
    }
    if (const std::unique_ptr<NetcdfFile> netcdf = open_netcdf4(request.file)) {
        if (std::unique_ptr<VolumeReader> reader = open_cf_variable(*netcdf, options)) return reader;
    }
    return open_hdf5_array(request);
}

}  // namespace isoatlas
