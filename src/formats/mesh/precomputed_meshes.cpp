#include "isoatlas/precomputed_meshes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/common/byte_writer.h"
#include "formats/common/length_unit.h"
#include "formats/mesh/draco_mesh.h"
#include "formats/zarr/folder_output.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::int32_t kMostOfPosition = (1 << 16) - 1;
constexpr double kRounding = 1e-4;  // of positions

/// From voxels to nanometres: three rows of four numbers.
std::vector<double> transform_of(const Geometry& geometry) {
    constexpr double kUnknown = 1e-3, kNanometres = 1e9;  // of a metre
    const double unit = metres_in(geometry.unit).value_or(kUnknown) * kNanometres;
    std::vector<double> rows;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) rows.push_back(geometry.direction[row][axis] * geometry.spacing[axis] * unit);
        rows.push_back(geometry.origin[row] * unit);
    }
    return rows;
}

/// edge: of the cell, in voxels.
std::vector<std::byte> encoded(const OctreeFragment& fragment, double edge) {
    std::vector<std::array<std::int32_t, 3>> points;
    for (const Vec3& p : fragment.points) {
        std::array<std::int32_t, 3>& rounded = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Points in the middle plane of a cell, but for rounding, are to be at 32768: readers part cells there.
            const double within = (p[axis] / edge - static_cast<double>(fragment.place[axis])) * kMostOfPosition + kRounding;
            rounded[axis] = static_cast<std::int32_t>(std::clamp(std::nearbyint(within), 0.0, static_cast<double>(kMostOfPosition)));
        }
    }
    return draco_mesh(points, fragment.triangles);
}

}  // namespace

struct PrecomputedMeshes::Data {
    std::string path;
    Geometry geometry;
    FolderOutput folder{path};
    std::vector<std::string> labels{};
    std::vector<double> taus{};
};

PrecomputedMeshes::PrecomputedMeshes(const std::string& path, const VolumeInfo& info)
    : data_(new Data{.path = path, .geometry = info.geometry}) {}
PrecomputedMeshes::~PrecomputedMeshes() = default;

void PrecomputedMeshes::add(const std::string& label, double reported_tau, const OctreeMesh& mesh) {
    if (mesh.levels.empty()) {
        throw Error(ErrorKind::usage,
                    {.file = data_->path, .what = "a mesh without triangles is no segment", .next = "leave out what has no surface"});
    }
    MemorySink manifest(label);
    ByteWriter out(manifest);
    const auto edge = static_cast<float>(mesh.edge);
    out.put(std::array{edge, edge, edge});
    out.put(std::array{0.0F, 0.0F, 0.0F});  // where the grid begins
    out.put(static_cast<std::uint32_t>(mesh.levels.size()));
    for (std::size_t k = 0; k < mesh.levels.size(); ++k) out.put(std::ldexp(1.0F, static_cast<int>(k)));  // voxels that it is for
    for (std::size_t k = 0; k < mesh.levels.size(); ++k) out.put(std::array{0.0F, 0.0F, 0.0F});           // offset of its points
    for (const OctreeLevel& level : mesh.levels) out.put(static_cast<std::uint32_t>(level.fragments.size()));
    std::vector<std::byte> fragments;
    for (std::size_t k = 0; k < mesh.levels.size(); ++k) {
        std::vector<std::uint32_t> sizes;
        for (const OctreeFragment& fragment : mesh.levels[k].fragments) {
            const std::vector<std::byte> bytes = encoded(fragment, std::ldexp(static_cast<double>(mesh.edge), static_cast<int>(k)));
            sizes.push_back(static_cast<std::uint32_t>(bytes.size()));
            fragments.insert(fragments.end(), bytes.begin(), bytes.end());
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const OctreeFragment& fragment : mesh.levels[k].fragments) out.put(static_cast<std::uint32_t>(fragment.place[axis]));
        }
        for (const std::uint32_t size : sizes) out.put(size);
    }
    out.finish();
    data_->labels.push_back(one_line(label));
    data_->taus.push_back(reported_tau);
    const std::string name = std::to_string(data_->labels.size());
    data_->folder.put(name + ".index", manifest.bytes());
    data_->folder.put(name, fragments);
}

void PrecomputedMeshes::commit() {
    const OrderedJson info{{"@type", "neuroglancer_multilod_draco"},
                           {"vertex_quantization_bits", 16},
                           {"transform", transform_of(data_->geometry)},
                           {"lod_scale_multiplier", 1},
                           {"segment_properties", "segment_properties"}};
    std::vector<std::string> ids;
    for (std::size_t i = 1; i <= data_->labels.size(); ++i) ids.push_back(std::to_string(i));
    OrderedJson properties = OrderedJson::array();
    properties.push_back({{"id", "label"}, {"type", "label"}, {"values", data_->labels}});
    properties.push_back({{"id", "isovalue"}, {"type", "number"}, {"data_type", "float32"}, {"values", data_->taus}});
    const OrderedJson listed{{"@type", "neuroglancer_segment_properties"}, {"inline", {{"ids", ids}, {"properties", properties}}}};
    data_->folder.put("segment_properties/info", listed.dump() + "\n");
    data_->folder.put("info", info.dump() + "\n");
    data_->folder.commit();
}

}  // namespace isoatlas
