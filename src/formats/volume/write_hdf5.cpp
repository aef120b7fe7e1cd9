// HDF5: one array of compressed chunks, /volume or /labels. HDF5 gives the layout, all bytes are written here.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "formats/common/hdf5_layout.h"
#include "formats/common/length_unit.h"
#include "formats/volume/write_hdf5.h"

namespace isoatlas {
namespace {

static_assert(std::endian::native == std::endian::little, "chunks are little endian");

constexpr int kDeflateLevel = 6;  // the default of zlib

/// Of each axis; an image has squares with as many samples.
Index3 chunk_of(const Extent& extent) {
    constexpr std::int64_t kCube = 64, kSquare = 512;
    const std::int64_t edge = extent.rank == 2 ? kSquare : kCube;
    Index3 chunk{};
    for (std::size_t a = 0; a < 3; ++a) chunk[a] = std::min(edge, extent.size[a]);
    return chunk;
}

/// The slowest axis first, as many as the volume has.
std::vector<std::int64_t> shape_of(const Index3& size, int rank) {
    std::vector<std::int64_t> shape;
    for (int a = rank; a-- > 0;) shape.push_back(size[static_cast<std::size_t>(a)]);
    return shape;
}

/// The bytes of all samples by significance (HDF5's filter shuffle), deflated.
std::vector<std::byte> encoded(std::span<const std::byte> chunk, std::size_t sample) {
    const std::size_t count = chunk.size() / sample;
    std::vector<std::byte> shuffled(chunk.size());
    for (std::size_t byte = 0; byte < sample; ++byte) {
        for (std::size_t i = 0; i < count; ++i) shuffled[byte * count + i] = chunk[i * sample + byte];
    }
    uLongf size = compressBound(static_cast<uLong>(shuffled.size()));
    std::vector<std::byte> packed(size);
    const int code = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(shuffled.data()),
                               static_cast<uLong>(shuffled.size()), kDeflateLevel);
    if (code != Z_OK) throw std::bad_alloc();
    packed.resize(size);
    return packed;
}

/// Takes samples in file order, and writes the chunks of a layer when it is whole.
class LayerWriter {
public:
    LayerWriter(Sink& sink, Hdf5Layout& layout, const VolumeInfo& info)
        : sink_(sink), layout_(layout), extent_(info.extent), chunk_(chunk_of(info.extent)), sample_(size_of(info.type)) {}

    void put(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const auto whole = static_cast<std::size_t>(extent_.slice() * layers()) * sample_;
            layer_.reserve(whole);
            const std::size_t part = std::min(bytes.size(), whole - layer_.size());
            layer_.insert(layer_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(part));
            bytes = bytes.subspan(part);
            if (layer_.size() == whole) write_layer();
        }
    }

private:
    /// Slices of the layer that comes next.
    [[nodiscard]] std::int64_t layers() const { return std::min(chunk_[2], extent_.size[2] - z_); }

    void write_layer() {
        const std::int64_t columns = (extent_.size[0] + chunk_[0] - 1) / chunk_[0], rows = (extent_.size[1] + chunk_[1] - 1) / chunk_[1];
        std::vector<std::vector<std::byte>> packed(static_cast<std::size_t>(columns));
        for (std::int64_t row = 0; row < rows; ++row) {
            for_each_block(0, columns, [&](std::int64_t column) {
                packed[static_cast<std::size_t>(column)] = encoded(chunk_at(column * chunk_[0], row * chunk_[1]), sample_);
            });
            for (const std::vector<std::byte>& chunk : packed)
                sink_.write_at(layout_.add_chunk(static_cast<std::int64_t>(chunk.size())), chunk);
        }
        z_ += layers();
        layer_.clear();
    }

    /// Beyond the volume it has zeros.
    [[nodiscard]] std::vector<std::byte> chunk_at(std::int64_t x, std::int64_t y) const {
        std::vector<std::byte> bytes(static_cast<std::size_t>(chunk_[0] * chunk_[1] * chunk_[2]) * sample_);
        const std::int64_t width = std::min(chunk_[0], extent_.size[0] - x), height = std::min(chunk_[1], extent_.size[1] - y);
        for (std::int64_t z = 0; z < layers(); ++z) {
            for (std::int64_t row = 0; row < height; ++row) {
                const std::int64_t from = z * extent_.slice() + (y + row) * extent_.size[0] + x, to = (z * chunk_[1] + row) * chunk_[0];
                std::memcpy(bytes.data() + static_cast<std::size_t>(to) * sample_, layer_.data() + static_cast<std::size_t>(from) * sample_,
                            static_cast<std::size_t>(width) * sample_);
            }
        }
        return bytes;
    }

    Sink& sink_;
    Hdf5Layout& layout_;
    const Extent& extent_;
    Index3 chunk_;
    std::size_t sample_;
    std::int64_t z_ = 0;
    std::vector<std::byte> layer_;
};

/// The attributes of a mesh of openPMD, those that microscopy programs read, and what neither has: docs/formats.md.
void set_geometry(Hdf5Layout& layout, const std::string& array, const VolumeInfo& info) {
    const Geometry geometry = regular_geometry(info);
    const auto rank = static_cast<std::size_t>(info.extent.rank);
    std::vector<double> spacing(rank), offset(rank), micrometres(rank), direction;
    const std::optional<double> metres = metres_in(geometry.unit);
    for (std::size_t i = 0; i < rank; ++i) {
        spacing[i] = geometry.spacing[rank - 1 - i], offset[i] = geometry.origin[rank - 1 - i];
        micrometres[i] = spacing[i] * (metres.value_or(0) / 1e-6);
    }
    layout.set_letters(array, "axisLabels", std::string_view("zyx").substr(3 - rank));
    layout.set_attribute(array, "gridSpacing", spacing);
    layout.set_attribute(array, "gridGlobalOffset", offset);
    if (metres) layout.set_attribute(array, "gridUnitSI", std::span<const double>(&*metres, 1));
    if (metres && rank == 3) layout.set_attribute(array, "element_size_um", micrometres);
    if (!geometry.unit.empty()) layout.set_attribute(array, "gridUnit", geometry.unit);
    if (geometry.space != Geometry{}.space && !geometry.space.empty()) layout.set_attribute(array, "space", geometry.space);
    const bool is_flat = rank == 2 && geometry.origin[2] == 0;
    if (geometry.direction == Geometry{}.direction && (rank == 3 || is_flat)) return;
    for (const Vec3& row : geometry.direction) direction.insert(direction.end(), row.begin(), row.end());
    layout.set_attribute(array, "gridOrigin", std::span<const double>(geometry.origin));
    layout.set_attribute(array, "gridDirection", direction);
}

void set_values(Hdf5Layout& layout, const std::string& array, const VolumeInfo& info) {
    if (!info.value_unit.empty()) layout.set_attribute(array, "units", info.value_unit);
    if (!info.description.empty()) layout.set_attribute(array, "long_name", info.description);
    if (info.calibration.is_linear_identity()) return;
    layout.set_attribute(array, "scale_factor", std::span(&info.calibration.slope, 1));
    layout.set_attribute(array, "add_offset", std::span(&info.calibration.intercept, 1));
}

void write_array(Sink& sink, const std::string& array, const VolumeInfo& info, const SampleFeed& samples, const KeyValues& pairs) {
    Hdf5Layout layout(sink.name(), 0);
    const int rank = info.extent.rank;
    layout.begin_chunks(array, name_of(info.type), shape_of(info.extent.size, rank), shape_of(chunk_of(info.extent), rank), kDeflateLevel);
    LayerWriter writer(sink, layout, info);
    samples([&](std::span<const std::byte> bytes) { writer.put(bytes); });
    set_geometry(layout, array, info);
    set_values(layout, array, info);
    for (const auto& [name, value] : pairs) {
        if (!value.empty()) layout.set_attribute(array, name.c_str(), value);
    }
    for (const Hdf5Layout::Piece& piece : layout.finish()) sink.write_at(piece.offset, piece.bytes);
    if (const std::int64_t end = layout.size(); sink.size() < end) {  // HDF5 may have allocated more than it uses
        const std::byte zero{0};
        sink.write_at(end - 1, std::span(&zero, 1));
    }
}

}  // namespace

void write_hdf5(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { write_array(sink, "/volume", info, samples, {}); }

void write_hdf5_labels(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, const KeyValues& pairs) {
    write_array(sink, "/labels", info, samples, pairs);
}

}  // namespace isoatlas
