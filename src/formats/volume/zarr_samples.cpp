#include "formats/volume/zarr_samples.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "formats/common/half.h"
#include "formats/volume/chunk_reader.h"
#include "formats/volume/sample_reader.h"
#include "formats/zarr/zarr_chunks.h"

namespace isoatlas {
namespace {

/// Larger chunks are cut into pieces, so that reading a few samples of a declared petabyte takes no memory for it.
constexpr std::int64_t kMostPieceBytes = std::int64_t{64} << 20;

template <std::size_t kBytes>
void gather(const std::byte* from, std::ptrdiff_t stride, std::int64_t count, std::byte* to) {
    for (std::int64_t i = 0; i < count; ++i) std::memcpy(to + i * static_cast<std::ptrdiff_t>(kBytes), from + i * stride, kBytes);
}

/// Samples of `bytes` each, `stride` bytes apart.
void gather_row(const std::byte* from, std::ptrdiff_t stride, std::size_t bytes, std::int64_t count, std::byte* to) {
    if (stride == static_cast<std::ptrdiff_t>(bytes)) {
        std::memcpy(to, from, static_cast<std::size_t>(count) * bytes);
    } else if (bytes == 1) {
        gather<1>(from, stride, count, to);
    } else if (bytes == 2) {
        gather<2>(from, stride, count, to);
    } else if (bytes == 4) {
        gather<4>(from, stride, count, to);
    } else {
        gather<8>(from, stride, count, to);
    }
}

class ZarrSamples {
public:
    ZarrSamples(const VolumeInfo& info, std::shared_ptr<KeyStore> store, ZarrArray array, const ZarrAxes& axes)
        : chunks_(std::move(store), std::move(array)), axes_(axes), extent_(info.extent), piece_(info.chunk), index_(this->array().rank()) {
        const std::vector<std::int64_t>& size = this->array().chunk;
        strides_.resize(size.size());
        std::int64_t stride = static_cast<std::int64_t>(this->array().type.stored_bytes);
        for (std::size_t i = size.size(); i-- > 0;) {
            const std::size_t axis = this->array().order[i];
            strides_[axis] = stride;
            stride *= size[axis];
        }
        for (const auto& [axis, at] : {std::pair{axes.time, info.volumes.time_step}, {axes.channel, info.volumes.channel}}) {
            if (axis < 0) continue;
            const auto place = static_cast<std::size_t>(axis);
            index_[place] = at / size[place];
            begin_ += at % size[place] * strides_[place];
        }
        wide_.type = this->array().type.wide;
        path_ = info.path;
    }

    /// Fills a piece, as large as info.chunk.
    void read(const Index3& piece, std::span<std::byte> out) {
        SampleBox box;
        for (std::size_t a = 0; a < 3; ++a) {
            box.begin[a] = piece[a] * piece_[a];
            box.end[a] = std::min(box.begin[a] + piece_[a], extent_.size[a]);
        }
        Index3 first, last;
        for (std::size_t a = 0; a < 3; ++a) first[a] = box.begin[a] / chunk_size(a), last[a] = (box.end[a] - 1) / chunk_size(a);
        for (std::int64_t z = first[2]; z <= last[2]; ++z) {
            for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                for (std::int64_t x = first[0]; x <= last[0]; ++x) take({x, y, z}, box, out);
            }
        }
    }

private:
    [[nodiscard]] const ZarrArray& array() const { return chunks_.array(); }
    /// Along an axis of the volume.
    [[nodiscard]] std::int64_t chunk_size(std::size_t a) const {
        return axes_.space[a] < 0 ? 1 : array().chunk[static_cast<std::size_t>(axes_.space[a])];
    }
    [[nodiscard]] std::int64_t stride(std::size_t a) const {
        return axes_.space[a] < 0 ? 0 : strides_[static_cast<std::size_t>(axes_.space[a])];
    }

    /// The samples of a chunk that lie in the box.
    void take(const Index3& chunk, const SampleBox& box, std::span<std::byte> out) {
        for (std::size_t a = 0; a < 3; ++a) {
            if (axes_.space[a] >= 0) index_[static_cast<std::size_t>(axes_.space[a])] = chunk[a];
        }
        const std::vector<std::byte>* stored = chunks_.read(index_);
        const Index3 size{chunk_size(0), chunk_size(1), chunk_size(2)}, corner{chunk[0] * size[0], chunk[1] * size[1], chunk[2] * size[2]};
        const Index3 begin = max(corner, box.begin), end = min(corner + size, box.end);
        const std::size_t sample = size_of(array().type.type);
        for (std::int64_t z = begin[2]; z < end[2]; ++z) {
            for (std::int64_t y = begin[1]; y < end[1]; ++y) {
                const std::int64_t place = begin[0] - box.begin[0] + piece_[0] * (y - box.begin[1] + piece_[1] * (z - box.begin[2]));
                const std::span<std::byte> row =
                    out.subspan(static_cast<std::size_t>(place) * sample, static_cast<std::size_t>(end[0] - begin[0]) * sample);
                if (stored == nullptr) {
                    fill(row, sample);
                } else {
                    const std::int64_t from =
                        begin_ + (begin[0] - corner[0]) * stride(0) + (y - corner[1]) * stride(1) + (z - corner[2]) * stride(2);
                    take_row(stored->data() + from, row, sample);
                }
                doubles_of_integers(row, wide_, path_);
            }
        }
    }

    void fill(std::span<std::byte> row, std::size_t sample) const {
        for (std::size_t at = 0; at < row.size(); at += sample) std::memcpy(row.data() + at, array().fill.data(), sample);
    }

    void take_row(const std::byte* from, std::span<std::byte> row, std::size_t sample) {
        const ZarrType& type = array().type;
        const auto count = static_cast<std::int64_t>(row.size() / sample);
        if (type.kind != ZarrType::Kind::half) {
            gather_row(from, stride(0), type.stored_bytes, count, row.data());
            if (needs_swap(type.big_endian)) swap_bytes(row, sample);
            return;
        }
        halves_.resize(static_cast<std::size_t>(count));
        const std::span<std::byte> bytes = std::as_writable_bytes(std::span(halves_));
        gather_row(from, stride(0), type.stored_bytes, count, bytes.data());
        if (needs_swap(type.big_endian)) swap_bytes(bytes, type.stored_bytes);
        for (std::size_t i = 0; i < halves_.size(); ++i) {
            const float value = float_of_half(halves_[i]);
            std::memcpy(row.data() + i * sample, &value, sample);
        }
    }

    ZarrChunks chunks_;
    ZarrAxes axes_;
    Extent extent_;
    Index3 piece_;                       ///< info.chunk
    std::vector<std::int64_t> strides_;  ///< of each axis of the array, in bytes of a chunk
    std::int64_t begin_ = 0;             ///< of the time step and the channel, inside a chunk
    std::vector<std::int64_t> index_;    ///< of a chunk; those of time and channel stay
    std::vector<std::uint16_t> halves_;
    WideIntegers wide_;
    std::string path_;  ///< for messages
};

}  // namespace

std::unique_ptr<VolumeReader> make_zarr_reader(VolumeInfo info, std::shared_ptr<KeyStore> store, ZarrArray array, const ZarrAxes& axes) {
    for (std::size_t a = 0; a < 3; ++a)
        info.chunk[a] = axes.space[a] < 0 ? 1 : std::min(array.chunk[static_cast<std::size_t>(axes.space[a])], info.extent.size[a]);
    const auto sample = static_cast<std::int64_t>(size_of(info.type));
    for (std::size_t a = 3; a-- > 0;) {  // whole rows as long as it can be
        std::int64_t others = sample;
        for (std::size_t b = 0; b < a; ++b) others = info.chunk[b] > kMostPieceBytes / others ? kMostPieceBytes : others * info.chunk[b];
        info.chunk[a] = std::min(info.chunk[a], std::max<std::int64_t>(1, kMostPieceBytes / others));
    }
    const auto samples = std::make_shared<ZarrSamples>(info, std::move(store), std::move(array), axes);
    return make_chunk_reader(std::move(info), [samples](const Index3& piece, std::span<std::byte> out) { samples->read(piece, out); });
}

}  // namespace isoatlas
