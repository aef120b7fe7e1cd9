// Samples of an array of HDF5: any box, read by hyperslabs.
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "field/copy_box.h"
#include "formats/volume/chunk_reader.h"
#include "formats/volume/half_source.h"
#include "formats/volume/hdf5_object.h"
#include "formats/volume/hdf5_storage.h"
#include "formats/volume/sample_reader.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

constexpr std::size_t kHdf5CacheBytes = std::size_t{64} << 20, kHdf5CacheSlots = 12421;  // decoded chunks kept; a prime
constexpr std::int64_t kMostChunksAtOnce = 4096;                                         // HDF5 takes memory for each chunk of a selection

hid_t memory_type_of(ValueType type, WideInteger wide) {
    if (wide != WideInteger::none) return wide == WideInteger::int64 ? H5T_NATIVE_INT64 : H5T_NATIVE_UINT64;
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
          is_half_(array.type.is_half),
          wide_(array.type.wide) {
        info_ = std::move(info);
        tidy_texts(info_);
        info_.slab_readable = true;
        const std::lock_guard lock(hdf5_mutex());
        try {
            open(array);
        } catch (...) {  // closed under the lock
            storage_.reset(), set_ = {}, type_ = {};
            throw;
        }
    }
    ~Hdf5Reader() override {
        const std::lock_guard lock(hdf5_mutex());
        storage_.reset(), set_ = {}, type_ = {};
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
        doubles_of_integers(out, place_.wide, info_.path);
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
        if (is_half_) {
            type_ = {H5Dget_type(set_), H5Tclose};
            type_ = {H5Tcopy(type_), H5Tclose};
            H5Tset_order(type_, H5Tget_order(H5T_NATIVE_UINT16));
        }
        storage_ = std::make_unique<Hdf5Storage>(file_, path_, set_, memory_type());
        if (storage_->has_chunks()) open_chunks();
    }

    [[nodiscard]] hid_t memory_type() const { return is_half_ ? static_cast<hid_t>(type_) : memory_type_of(stored_, wide_); }
    [[nodiscard]] std::size_t memory_bytes() const { return is_half_ ? 2 : size_of(stored_); }

    /// Along an axis of the volume, of the whole array or of a chunk.
    [[nodiscard]] std::int64_t along(const std::vector<std::int64_t>& sizes, std::size_t a) const {
        return place_.dimension[a] < 0 ? 1 : sizes[static_cast<std::size_t>(place_.dimension[a])];
    }

    /// Chunks are kept; large ones are cut into pieces, so that a few samples of a declared petabyte take no memory for it.
    void open_chunks() {
        constexpr std::int64_t kMostPieceBytes = kChunkCacheBytes;
        VolumeInfo info;
        info.path = info_.path;
        info.type = is_half_ ? ValueType::u16 : stored_;
        info.extent.rank = 3;
        auto others = static_cast<std::int64_t>(memory_bytes());
        for (std::size_t a = 0; a < 3; ++a) {
            info.extent.size[a] = along(storage_->dims(), a);
            info.chunk[a] =
                std::clamp<std::int64_t>(kMostPieceBytes / others, 1, std::min(along(storage_->chunk(), a), info.extent.size[a]));
            others *= info.chunk[a];
        }
        const auto read = [this, size = info.chunk, all = info.extent.size](const Index3& piece, std::span<std::byte> out) {
            Index3 begin{piece[0] * size[0], piece[1] * size[1], piece[2] * size[2]};
            read_piece({begin, begin + size}, all, out);
        };
        chunks_ = make_chunk_reader(std::move(info), read);
    }

    /// Samples of a box of the array; where it lies in several chunks only those inside `all`.
    void read_piece(const SampleBox& box, const Index3& all, std::span<std::byte> out) {
        const Index3 end = min(box.end, all);
        Index3 chunk, first, last;
        for (std::size_t a = 0; a < 3; ++a)
            chunk[a] = along(storage_->chunk(), a), first[a] = box.begin[a] / chunk[a], last[a] = (end[a] - 1) / chunk[a];
        if (first == last && min(box.end, {(first[0] + 1) * chunk[0], (first[1] + 1) * chunk[1], (first[2] + 1) * chunk[2]}) == box.end)
            return read_box_of_array(box, out);
        for (std::int64_t z = first[2]; z <= last[2]; ++z) {
            for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                for (std::int64_t x = first[0]; x <= last[0]; ++x) {
                    const Index3 corner{x * chunk[0], y * chunk[1], z * chunk[2]};
                    const SampleBox part{max(corner, box.begin), min(corner + chunk, end)};
                    part_.resize(static_cast<std::size_t>(part.size().product()) * memory_bytes());
                    read_box_of_array(part, part_);
                    copy_box(part.size(), {part_, part.size(), {0, 0, 0}}, {out, box.size(), part.begin - box.begin}, memory_bytes());
                }
            }
        }
    }

    void read_box_of_array(const SampleBox& box, std::span<std::byte> out) {
        std::vector<std::int64_t> first = place_.index, count(rank_, 1);
        for (std::size_t a = 0; a < 3; ++a) {
            if (place_.dimension[a] < 0) continue;
            const auto d = static_cast<std::size_t>(place_.dimension[a]);
            first[d] = box.begin[a], count[d] = box.size()[a];
        }
        storage_->read(first, count, out);
    }

    void read_stored(const SampleBox& box, std::byte* out) {
        if (!storage_->is_own()) return read_by_library(box, out);
        SampleBox of_array = box;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::int64_t begin = place_.dimension[a] < 0 ? 0 : place_.index[static_cast<std::size_t>(place_.dimension[a])];
            of_array.begin[a] += begin, of_array.end[a] += begin;
        }
        const std::span<std::byte> bytes(out, static_cast<std::size_t>(box.size().product()) * memory_bytes());
        chunks_ != nullptr ? chunks_->read_box(of_array, bytes) : read_box_of_array(of_array, bytes);
    }

    /// Samples in other files, and behind filters that only HDF5 has.
    void read_by_library(const SampleBox& box, std::byte* out) {
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
        if (!is_selected || H5Dread(set_, memory_type(), memory, space, H5P_DEFAULT, out) < 0)
            data.fail(path_, "the samples cannot be read");
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
    WideInteger wide_;
    Hdf5Handle set_, type_;
    std::unique_ptr<Hdf5Storage> storage_;
    std::unique_ptr<VolumeReader> chunks_;  ///< of the whole array
    std::vector<std::byte> part_;
};

}  // namespace

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
    place.wide.type = array.type.wide;
    if (array.type.wide != WideInteger::none) info.notes.push_back(note_of(array.type.wide));
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
                                             .expected = "8 to 64 bit integers, float16, float32 or float64",
                                             .next = "convert the array, in Python with array.astype(\"float64\")"});
    }
    ISOATLAS_CHECK((place.wide.type == WideInteger::none) == (array.type.wide == WideInteger::none));
    if (array.type.is_half) info.notes.emplace_back("samples of 16 bits in floating point are read as float32");
    static_cast<void>(sample_bytes(info.path, info.extent, info.type));
    return std::make_unique<Hdf5Reader>(std::move(info), std::move(file), array, place);
}

}  // namespace isoatlas
