// Samples of an array of HDF5: any box, read by hyperslabs.
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/half_source.h"
#include "formats/volume/hdf5_object.h"
#include "formats/volume/sample_reader.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr std::size_t kHdf5CacheBytes = std::size_t{64} << 20, kHdf5CacheSlots = 12421;  // decoded chunks kept; a prime
constexpr std::int64_t kMostChunksAtOnce = 4096;                                         // HDF5 takes memory for each chunk of a selection

hid_t memory_type_of(ValueType type) {
    switch (type) {
        case ValueType::u8: return H5T_NATIVE_UINT8;
        case ValueType::i8: return H5T_NATIVE_INT8;
        case ValueType::u16: return H5T_NATIVE_UINT16;
        case ValueType::i16: return H5T_NATIVE_INT16;
        case ValueType::u32: return H5T_NATIVE_UINT32;
        case ValueType::i32: return H5T_NATIVE_INT32;
        case ValueType::f32: return H5T_NATIVE_FLOAT;
        case ValueType::f64: break;
    }
    return H5T_NATIVE_DOUBLE;
}

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
        if (id >= 0 && H5Zfilter_avail(id) > 0) continue;
        throw Error(
            ErrorKind::unsupported,
            {.file = file,
             .where = shown_name(path),
             .what = "the samples are compressed by the HDF5 filter " + filter_name(id, name) + ", which is not installed here",
             .expected = "gzip, szip, shuffle or another filter of HDF5 itself",
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
void check_file(const Hdf5Access& access, const std::string& header, const std::string& name, std::uint64_t least) {
    const std::string file = beside(header, name);
    if (!access.follow_links) require_own_folder(access.path, file);
    const auto size = static_cast<std::uint64_t>(file_size(file));  // throws when it is not there: HDF5 would fill the samples in
    if (size < least) samples_missing(file, name, least, size);
}

void check_external(const Hdf5Access& access, const std::string& header, hid_t creation) {
    const int files = H5Pget_external_count(creation);
    for (int i = 0; i < files; ++i) {
        std::array<char, 4096> name{};
        off_t offset = 0;
        hsize_t size = 0;
        if (H5Pget_external(creation, static_cast<unsigned>(i), name.size() - 1, name.data(), &offset, &size) < 0) continue;
        const bool is_bounded = size != H5F_UNLIMITED && size < (std::uint64_t{1} << 62) && offset >= 0;
        check_file(access, header, name.data(), is_bounded ? static_cast<std::uint64_t>(offset) + size : 0);
    }
}

void check_virtual(const Hdf5Access& access, const std::string& header, hid_t creation) {
    constexpr std::size_t kMostSources = 65536;
    std::size_t count = 0;
    H5Pget_virtual_count(creation, &count);
    std::string last;
    for (std::size_t i = 0; i < std::min(count, kMostSources); ++i) {
        std::array<char, 4096> name{};
        if (H5Pget_virtual_filename(creation, i, name.data(), name.size() - 1) <= 0) continue;
        const std::string source = name.data();
        if (source == "." || source == last || source.find('%') != std::string::npos) continue;  // %b stands for a number
        check_file(access, header, source, 0);
        last = source;
    }
}

/// A part of a volume whose chunks are few.
Index3 step_of(const Index3& chunk, const Index3& size) {
    Index3 step = size;
    const auto chunks = [&](std::size_t axis) { return (step[axis] - 1) / chunk[axis] + 2; };
    for (const std::size_t axis : {2, 1, 0}) {
        const std::int64_t others = axis == 2   ? std::min(chunks(0), kMostChunksAtOnce) * std::min(chunks(1), kMostChunksAtOnce)
                                    : axis == 1 ? chunks(0)
                                                : 1;
        const std::int64_t room = std::max<std::int64_t>(kMostChunksAtOnce / std::min(others, kMostChunksAtOnce), 1);
        step[axis] = std::min(step[axis], room * chunk[axis]);
    }
    return step;
}

/// Reverses the order of the samples of a box along axes.
void flip_box(std::span<std::byte> samples, const Index3& size, const std::array<bool, 3>& axes, std::size_t bytes) {
    const auto at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        return samples.data() + static_cast<std::size_t>(x + size[0] * (y + size[1] * z)) * bytes;
    };
    for (std::int64_t z = 0; z < size[2]; ++z) {
        for (std::int64_t y = 0; y < size[1]; ++y) {
            for (std::int64_t x = 0; x < size[0]; ++x) {
                const std::int64_t to_x = axes[0] ? size[0] - 1 - x : x, to_y = axes[1] ? size[1] - 1 - y : y,
                                   to_z = axes[2] ? size[2] - 1 - z : z;
                std::byte *from = at(x, y, z), *to = at(to_x, to_y, to_z);
                if (from < to) std::swap_ranges(from, from + bytes, to);
            }
        }
    }
}

class Hdf5Reader final : public VolumeReader {
public:
    Hdf5Reader(VolumeInfo info, std::shared_ptr<const Hdf5File> file, const Hdf5Array& array, Hdf5Place place)
        : file_(std::move(file)),
          path_(array.path),
          place_(std::move(place)),
          rank_(array.dims.size()),
          stored_(*array.type.value),
          is_half_(array.type.is_half) {
        info_ = std::move(info);
        tidy_texts(info_);
        info_.slab_readable = true;
        const std::lock_guard lock(hdf5_mutex());
        try {
            open(array);
        } catch (...) {  // closed under the lock
            set_ = {}, type_ = {};
            throw;
        }
    }
    ~Hdf5Reader() override {
        const std::lock_guard lock(hdf5_mutex());
        set_ = {}, type_ = {};
    }
    Hdf5Reader(const Hdf5Reader&) = delete;
    Hdf5Reader& operator=(const Hdf5Reader&) = delete;

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        if (z_begin < z_end) read_box({{0, 0, z_begin}, {info_.extent.size[0], info_.extent.size[1], z_end}}, out);
    }

    void read_box(const SampleBox& box, std::span<std::byte> out) override {
        ISOATLAS_CHECK(is_inside(box, info_.extent));
        ISOATLAS_CHECK(out.size() == static_cast<std::size_t>(box.size().product()) * size_of(info_.type));
        SampleBox stored = box;
        for (std::size_t a = 0; a < 3; ++a) {
            if (!place_.flipped[a]) continue;
            stored.begin[a] = info_.extent.size[a] - box.end[a];
            stored.end[a] = info_.extent.size[a] - box.begin[a];
        }
        const std::size_t behind = is_half_ ? out.size() / 2 : 0;  // halves are widened where they are, from the first on
        read_stored(stored, out.data() + behind);
        if (is_half_) widen(out);
        if (std::ranges::find(place_.flipped, true) != place_.flipped.end()) flip_box(out, box.size(), place_.flipped, size_of(info_.type));
    }

private:
    void open(const Hdf5Array& array) {
        Hdf5File::Data& data = file_->data();
        double chunk_bytes = static_cast<double>(size_of(info_.type));
        for (const std::int64_t size : array.chunk) chunk_bytes *= static_cast<double>(size);
        const auto cache = static_cast<std::size_t>(std::clamp(chunk_bytes, static_cast<double>(kHdf5CacheBytes), 0x1p32));
        const Hdf5Handle properties(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
        H5Pset_chunk_cache(properties, kHdf5CacheSlots, array.chunk.empty() ? 0 : cache, 1);
        H5Pset_efile_prefix(properties, "${ORIGIN}");
        set_ = data.open_array(path_, properties);
        data.check_storage(set_, path_);
        if (!is_half_) return;
        type_ = {H5Dget_type(set_), H5Tclose};
        type_ = {H5Tcopy(type_), H5Tclose};
        H5Tset_order(type_, H5Tget_order(H5T_NATIVE_UINT16));
    }

    void read_stored(const SampleBox& box, std::byte* out) {
        const std::lock_guard lock(hdf5_mutex());
        const Hdf5Handle space(H5Dget_space(set_), H5Sclose);
        const Index3 size = box.size(), step = info_.chunk.product() > 0 ? step_of(info_.chunk, size) : size;
        Index3 at = box.begin;
        for (at[2] = box.begin[2]; at[2] < box.end[2]; at[2] += step[2]) {
            for (at[1] = box.begin[1]; at[1] < box.end[1]; at[1] += step[1]) {
                for (at[0] = box.begin[0]; at[0] < box.end[0]; at[0] += step[0]) read_part(space, box, {at, min(at + step, box.end)}, out);
            }
        }
    }

    void read_part(hid_t space, const SampleBox& box, const SampleBox& part, std::byte* out) {
        std::array<hsize_t, H5S_MAX_RANK> start{}, count{};
        for (std::size_t d = 0; d < rank_; ++d) start[d] = static_cast<hsize_t>(place_.index[d]), count[d] = 1;
        std::array<hsize_t, 3> whole{1, 1, 1}, first{}, some{1, 1, 1};  // of memory, the slowest first
        for (std::size_t a = 0; a < 3; ++a) {
            whole[2 - a] = static_cast<hsize_t>(box.size()[a]);
            first[2 - a] = static_cast<hsize_t>(part.begin[a] - box.begin[a]);
            some[2 - a] = static_cast<hsize_t>(part.size()[a]);
            if (place_.dimension[a] < 0) continue;
            const auto d = static_cast<std::size_t>(place_.dimension[a]);
            start[d] += static_cast<hsize_t>(part.begin[a]);
            count[d] = some[2 - a];
        }
        Hdf5File::Data& data = file_->data();
        data.access.forget();
        const Hdf5Handle memory(H5Screate_simple(3, whole.data(), nullptr), H5Sclose);
        const bool is_selected = H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
                                 H5Sselect_hyperslab(memory, H5S_SELECT_SET, first.data(), nullptr, some.data(), nullptr) >= 0;
        const hid_t type = is_half_ ? static_cast<hid_t>(type_) : memory_type_of(stored_);
        if (!is_selected || H5Dread(set_, type, memory, space, H5P_DEFAULT, out) < 0) data.fail(path_, "the samples cannot be read");
        // What HDF5 fills in for a file that it could not read is no sample.
        if (data.access.failure) data.fail(path_, "the samples cannot be read");
    }

    static void widen(std::span<std::byte> out) {
        const std::size_t samples = out.size() / sizeof(float);
        for (std::size_t i = 0; i < samples; ++i) {
            std::uint16_t half = 0;
            std::memcpy(&half, out.data() + out.size() / 2 + 2 * i, sizeof half);
            const float value = float_of_half(half);
            std::memcpy(out.data() + 4 * i, &value, sizeof value);
        }
    }

    std::shared_ptr<const Hdf5File> file_;
    std::string path_;
    Hdf5Place place_;
    std::size_t rank_;
    ValueType stored_;  ///< as large as info_.type
    bool is_half_;
    Hdf5Handle set_, type_;
};

}  // namespace

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

void Hdf5File::Data::check_storage(hid_t set, const std::string& path) {
    const Hdf5Handle creation(H5Dget_create_plist(set), H5Pclose), own(H5Iget_file_id(set), H5Fclose), type(H5Dget_type(set), H5Tclose);
    hsize_t size = 0;
    std::array<char, 4096> name{};
    if (creation < 0 || H5Fget_filesize(own, &size) < 0 || H5Fget_name(own, name.data(), name.size() - 1) < 0)
        fail(path, "the array cannot be read");
    check_filters(access.path, path, creation);
    const H5D_layout_t layout = H5Pget_layout(creation);
    if (layout == H5D_VIRTUAL) check_virtual(access, name.data(), creation);
    if (layout == H5D_CHUNKED) {
        std::array<hsize_t, H5S_MAX_RANK> chunk{};
        const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, chunk.data());
        double bytes = static_cast<double>(H5Tget_size(type));
        for (int d = 0; d < rank; ++d) bytes *= static_cast<double>(chunk[static_cast<std::size_t>(d)]);
        if (H5Dget_storage_size(set) > 0) check_chunk(*this, path, creation, bytes, static_cast<double>(size));
    }
    if (layout != H5D_CONTIGUOUS) return;
    if (H5Pget_external_count(creation) > 0) return check_external(access, name.data(), creation);
    const haddr_t begin = H5Dget_offset(set);
    const hsize_t bytes = H5Dget_storage_size(set);
    if (begin != HADDR_UNDEF && (begin > size || bytes > size - begin)) samples_missing(access.path, path, begin + bytes, size);
}

Hdf5Place place_volume(const Hdf5Array& array, int rank, VolumeInfo& info) {
    const std::size_t dims = array.dims.size();
    ISOATLAS_CHECK(dims >= static_cast<std::size_t>(rank));
    Hdf5Place place;
    place.index.assign(dims, 0);
    info.extent = {.rank = rank, .size = {1, 1, 1}};
    info.chunk = array.chunk.empty() ? Index3{0, 0, 0} : Index3{1, 1, 1};
    for (std::size_t a = 0; a < static_cast<std::size_t>(rank); ++a) {
        const std::size_t d = dims - 1 - a;
        place.dimension[a] = static_cast<int>(d);
        info.extent.size[a] = array.dims[d];
        if (!array.chunk.empty()) info.chunk[a] = std::clamp<std::int64_t>(array.chunk[d], 1, std::max<std::int64_t>(array.dims[d], 1));
    }
    if (array.type.value) info.type = *array.type.value;
    info.big_endian = array.type.big_endian;
    info.encoding = array.encoding;
    return place;
}

std::unique_ptr<VolumeReader> make_hdf5_reader(VolumeInfo info, std::shared_ptr<const Hdf5File> file, const Hdf5Array& array,
                                               const Hdf5Place& place) {
    if (!array.type.value) {
        throw Error(ErrorKind::unsupported, {.file = info.path,
                                             .where = shown_name(array.path),
                                             .what = array.type.name + " samples are not supported",
                                             .expected = "8 to 32 bit integers, float16, float32 or float64",
                                             .next = "convert the array, in Python with array.astype(\"float64\")"});
    }
    if (array.type.is_half) info.notes.emplace_back("samples of 16 bits in floating point are read as float32");
    static_cast<void>(sample_bytes(info.path, info.extent, info.type));
    return std::make_unique<Hdf5Reader>(std::move(info), std::move(file), array, place);
}

}  // namespace isoatlas
