// Arrays of HDF5 before they are read: their types, their filters, and what of their storage is there.
#include "formats/volume/hdf5_object.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/hdf5_filters.h"
#include "formats/volume/hdf5_virtual.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

std::string filter_name(H5Z_filter_t id, std::string name) {
    constexpr std::array<std::pair<int, const char*>, 12> kKnown{{{307, "bzip2"},
                                                                  {32000, "LZF"},
                                                                  {32001, "Blosc"},
                                                                  {32004, "LZ4"},
                                                                  {32008, "bitshuffle"},
                                                                  {32013, "ZFP"},
                                                                  {32015, "Zstandard"},
                                                                  {32017, "SZ"},
                                                                  {32019, "JPEG"},
                                                                  {32023, "Granular BitRound"},
                                                                  {32026, "Blosc2"},
                                                                  {4, "SZIP"}}};
    for (const auto& [known, text] : kKnown) {
        if (id == known) name = text;
    }
    return std::to_string(id) + (name.empty() ? "" : " (" + shown_name(name) + ")");
}

void check_filters(const std::string& file, const std::string& path, hid_t creation) {
    for (const auto& [id, name] : hdf5_filters(creation)) {
        if (is_known_hdf5_filter({id}) || (id >= 0 && H5Zfilter_avail(id) > 0)) continue;
        throw Error(
            ErrorKind::unsupported,
            {.file = file,
             .where = shown_name(path),
             .what = "the samples are compressed by the HDF5 filter " + filter_name(id, name) + ", which is not installed here",
             .expected = "a filter of HDF5 itself (gzip, szip, shuffle, ...), LZF, Blosc, LZ4 or Zstandard",
             .next =
                 "install its plugin and name the folder in HDF5_PLUGIN_PATH, or write the array with gzip, for example with h5repack"});
    }
}

/// Deflate makes at most 1032 bytes of one; other filters have no bound.
void check_chunk(Hdf5File::Data& data, const std::string& path, hid_t creation, double chunk_bytes, double file_bytes) {
    constexpr double kMostOfDeflate = 1032;
    const int count = H5Pget_nfilters(creation);
    double ratio = 1;
    for (int i = 0; i < count; ++i) {
        unsigned flags = 0;
        std::size_t values = 0;
        const H5Z_filter_t id = H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, 0, nullptr, nullptr);
        if (id == H5Z_FILTER_DEFLATE)
            ratio *= kMostOfDeflate;
        else if (id != H5Z_FILTER_SHUFFLE && id != H5Z_FILTER_FLETCHER32)
            return;
    }
    if (chunk_bytes > ratio * file_bytes) data.fail(path, "a chunk of the array is larger than the file can hold");
}

[[noreturn]] void samples_missing(const std::string& file, const std::string& path, std::uint64_t wanted, std::uint64_t size) {
    throw Error(ErrorKind::input, {.file = file,
                                   .where = shown_name(path),
                                   .what = "the file has " + std::to_string(size) + " bytes",
                                   .expected = std::to_string(wanted) + ", up to the last sample",
                                   .next = "the file is truncated: get it again"});
}

/// Files beside the file in which the samples of an array lie.
void check_external(const Hdf5Access& access, const std::string& header, hid_t creation) {
    const int files = H5Pget_external_count(creation);
    for (int i = 0; i < files; ++i) {
        std::array<char, 4096> name{};
        off_t offset = 0;
        hsize_t size = 0;
        if (H5Pget_external(creation, static_cast<unsigned>(i), name.size() - 1, name.data(), &offset, &size) < 0) continue;
        const bool is_bounded = size != H5F_UNLIMITED && size < (std::uint64_t{1} << 62) && offset >= 0;
        const std::uint64_t least = is_bounded ? static_cast<std::uint64_t>(offset) + size : 0;
        const std::string file = file_beside(access, header, name.data());
        const auto bytes = static_cast<std::uint64_t>(file_size(file));  // throws when it is not there: HDF5 would fill the samples in
        if (bytes < least) samples_missing(file, name.data(), least, bytes);
    }
}

}  // namespace

std::string file_beside(const Hdf5Access& access, const std::string& header, const std::string& name) {
    std::string file = beside(header, name);
    if (!access.follow_links) require_own_folder(access.path, file);
    return file;
}

std::vector<Hdf5Filter> hdf5_filters(hid_t creation) {
    std::vector<Hdf5Filter> filters;
    const int count = H5Pget_nfilters(creation);
    for (int i = 0; i < count; ++i) {
        unsigned flags = 0, config = 0;
        std::size_t values = 0;
        std::array<char, 64> name{};
        const H5Z_filter_t id =
            H5Pget_filter2(creation, static_cast<unsigned>(i), &flags, &values, nullptr, name.size() - 1, name.data(), &config);
        filters.push_back({id, name.data()});
    }
    return filters;
}

Hdf5Type hdf5_type_of(hid_t type) {
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_ENUM) {
        const Hdf5Handle numbers(H5Tget_super(type), H5Tclose);
        return numbers >= 0 && H5Tget_class(numbers) == H5T_INTEGER ? hdf5_type_of(numbers) : Hdf5Type{.name = "enumeration"};
    }
    const std::size_t size = H5Tget_size(type);
    Hdf5Type found;
    if (kind == H5T_INTEGER) {
        const bool is_signed = H5Tget_sign(type) != H5T_SGN_NONE;
        found = {.name = (is_signed ? "int" : "uint") + std::to_string(8 * size), .is_number = true};
        if (size == 1) found.value = is_signed ? ValueType::i8 : ValueType::u8;
        if (size == 2) found.value = is_signed ? ValueType::i16 : ValueType::u16;
        if (size == 3 || size == 4) found.value = is_signed ? ValueType::i32 : ValueType::u32;
        if (size > 4 && size <= 8) found.value = ValueType::f64, found.wide = is_signed ? WideInteger::int64 : WideInteger::uint64;
    } else if (kind == H5T_FLOAT) {
        found = {.name = "float" + std::to_string(8 * size), .is_number = true};
        if (size <= 8) found.value = size <= 4 ? ValueType::f32 : ValueType::f64;
        std::size_t sign = 0, exponent = 0, exponent_bits = 0, fraction = 0, fraction_bits = 0;
        H5Tget_fields(type, &sign, &exponent, &exponent_bits, &fraction, &fraction_bits);
        found.is_half = size == 2 && sign == 15 && exponent == 10 && exponent_bits == 5 && fraction == 0 && fraction_bits == 10 &&
                        H5Tget_ebias(type) == 15;
    } else {
        constexpr std::array<std::pair<H5T_class_t, const char*>, 7> kNames{{{H5T_STRING, "text"},
                                                                             {H5T_COMPOUND, "compound"},
                                                                             {H5T_REFERENCE, "references"},
                                                                             {H5T_BITFIELD, "bits"},
                                                                             {H5T_OPAQUE, "opaque"},
                                                                             {H5T_VLEN, "lists"},
                                                                             {H5T_ARRAY, "arrays"}}};
        for (const auto& [known, name] : kNames) {
            if (kind == known) found.name = name;
        }
        return found;
    }
    found.big_endian = size > 1 && H5Tget_order(type) == H5T_ORDER_BE;
    return found;
}

haddr_t offset_of_samples(hid_t set) {
    const Hdf5Handle file(H5Iget_file_id(set), H5Fclose), creation(H5Fget_create_plist(file), H5Pclose);
    hsize_t block = 0;
    H5Pget_userblock(creation, &block);
    const haddr_t begin = H5Dget_offset(set);
    return begin == HADDR_UNDEF + block ? HADDR_UNDEF : begin;  // HDF5 adds the size of the user block to any
}

void Hdf5File::Data::check_storage(hid_t set, const std::string& path) {
    const Hdf5Handle creation(H5Dget_create_plist(set), H5Pclose), own(H5Iget_file_id(set), H5Fclose), type(H5Dget_type(set), H5Tclose);
    hsize_t size = 0;
    std::array<char, 4096> name{};
    if (creation < 0 || H5Fget_filesize(own, &size) < 0 || H5Fget_name(own, name.data(), name.size() - 1) < 0)
        fail(path, "the array cannot be read");
    check_filters(access.path, path, creation);
    const H5D_layout_t layout = H5Pget_layout(creation);
    if (layout == H5D_VIRTUAL) check_sources(*this, set, path);
    if (layout == H5D_CHUNKED) {
        std::array<hsize_t, H5S_MAX_RANK> chunk{};
        const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, chunk.data());
        double bytes = static_cast<double>(H5Tget_size(type));
        for (int d = 0; d < rank; ++d) bytes *= static_cast<double>(chunk[static_cast<std::size_t>(d)]);
        if (H5Dget_storage_size(set) > 0) check_chunk(*this, path, creation, bytes, static_cast<double>(size));
    }
    if (layout != H5D_CONTIGUOUS) return;
    if (H5Pget_external_count(creation) > 0) return check_external(access, name.data(), creation);
    const haddr_t begin = offset_of_samples(set);
    const hsize_t bytes = H5Dget_storage_size(set);
    if (begin != HADDR_UNDEF && (begin > size || bytes > size - begin)) samples_missing(access.path, path, begin + bytes, size);
}

}  // namespace isoatlas
