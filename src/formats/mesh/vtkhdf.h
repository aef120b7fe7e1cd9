// VTKHDF 2.0, Type PolyData: what files of one surface and of evolutions have in common. HDF5 gives the layout, all bytes are written here.
// Source: VTKHDF file format, docs.vtk.org.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "formats/common/byte_writer.h"
#include "formats/common/hdf5_layout.h"
#include "formats/common/precision.h"
#include "formats/mesh/mesh_parts.h"
#include "isoatlas/sink.h"

namespace isoatlas {

/// The kinds of cells, in VTK's order. Surfaces have Polygons, curves Lines; the others are there without a cell.
inline constexpr std::array<const char*, 4> kVtkhdfCells{"Vertices", "Lines", "Polygons", "Strips"};
inline constexpr std::size_t kVtkhdfLines = 1, kVtkhdfPolygons = 2;

/// An array of one surface, or what one step of an evolution adds to it.
struct VtkhdfArray {
    std::string name;  ///< from the root
    const char* type;  ///< of Hdf5Layout
    std::int64_t columns;
    std::int64_t rows;
    bool is_long;  ///< a row for each point or cell; else one for each surface
    std::function<void(ByteWriter&)> put;
};
/// parts must outlive it.
[[nodiscard]] std::vector<VtkhdfArray> vtkhdf_arrays(const MeshParts& parts, Real position);

/// Field data: as in .vtp.
struct VtkhdfFields {
    std::vector<std::pair<std::string, std::vector<double>>> numbers;
    std::vector<std::pair<std::string, std::vector<std::string>>> texts;
};
[[nodiscard]] VtkhdfFields vtkhdf_fields(const MeshParts& parts);

/// Where an array of a layout goes: one piece of a file, from an offset on.
class PlacedSink final : public Sink {
public:
    PlacedSink(Sink& sink, std::int64_t offset) : Sink(sink.name()), sink_(sink), begin_(offset) {}
    using Sink::write;
    void write(std::span<const std::byte> bytes) override {
        if (!bytes.empty()) sink_.write_at(begin_ + size_, bytes);
        size_ += static_cast<std::int64_t>(bytes.size());
    }
    void write_at(std::int64_t offset, std::span<const std::byte> bytes) override { sink_.write_at(begin_ + offset, bytes); }
    [[nodiscard]] std::int64_t size() const override { return size_; }

private:
    Sink& sink_;
    std::int64_t begin_, size_ = 0;
};

/// Adds an array and writes it.
void place_array(Sink& sink, Hdf5Layout& layout, const std::string& name, const char* type, const std::vector<std::int64_t>& shape,
                 const std::function<void(ByteWriter&)>& put);
/// Adds the field data and the attributes of the file: the last thing to do but for finish_vtkhdf().
void place_fields(Sink& sink, Hdf5Layout& layout, const VtkhdfFields& fields);
void set_attributes(Hdf5Layout& layout, const MeshParts& parts);
/// Writes HDF5's own structures.
void finish_vtkhdf(Sink& sink, Hdf5Layout& layout);

}  // namespace isoatlas
