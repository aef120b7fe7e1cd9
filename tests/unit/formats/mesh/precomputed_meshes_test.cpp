// Folders of meshes for Neuroglancer, read as it reads them: manifests by offsets, fragments by Draco, positions in their cells.
#include "isoatlas/precomputed_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <tuple>

#include <draco/compression/decode.h>
#include <nlohmann/json.hpp>

#include "isoatlas/error.h"
#include "isoatlas/phantom.h"
#include "isoatlas/surface.h"
#include "unit/formats/mesh/mesh_samples.h"
#include "unit/formats/volume/volume_files.h"

using namespace isoatlas;
using mesh_samples::Folder;
using mesh_samples::read_bytes;
using Corner = std::array<std::int64_t, 3>;
using Shape = std::vector<std::array<Corner, 3>>;

namespace {

constexpr double kMost = 65535;

class Manifest {
public:
    explicit Manifest(const std::string& bytes) : bytes_(bytes) {}
    template <class T>
    T next() {
        T value{};
        EXPECT_LE(at_ + sizeof(T), bytes_.size());
        std::memcpy(&value, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

/// Each triangle from the corner that makes it least (rounded corners may be equal), sorted: without the order of points and triangles.
Shape sorted(Shape shape) {
    for (auto& [a, b, c] : shape) std::tie(a, b, c) = std::min({std::tuple(a, b, c), std::tuple(b, c, a), std::tuple(c, a, b)});
    std::ranges::sort(shape);
    return shape;
}

Shape decoded(const std::string& bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    const auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    EXPECT_TRUE(mesh.ok());
    const draco::PointAttribute& position = *mesh.value()->GetNamedAttribute(draco::GeometryAttribute::POSITION);
    EXPECT_EQ(position.data_type(), draco::DT_INT32);
    EXPECT_EQ(position.num_components(), 3);
    EXPECT_EQ(position.size(), mesh.value()->num_points());
    EXPECT_EQ(mesh.value()->GetAttributeElementType(static_cast<int>(position.unique_id())), draco::MESH_CORNER_ATTRIBUTE);
    Shape shape;
    for (std::uint32_t i = 0; i < mesh.value()->num_faces(); ++i) {
        auto& t = shape.emplace_back();
        for (std::size_t corner = 0; corner < 3; ++corner) {
            std::array<std::int32_t, 3> at{};
            position.GetMappedValue(mesh.value()->face(draco::FaceIndex(i))[corner], at.data());
            t[corner] = {at[0], at[1], at[2]};
        }
    }
    return sorted(shape);
}

Shape rounded(const OctreeFragment& fragment, double edge) {
    Shape shape;
    for (const auto& corners : fragment.triangles) {
        auto& t = shape.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double at = fragment.points[corners[i]][axis] / edge - static_cast<double>(fragment.place[axis]);
                t[i][axis] = std::llround(std::clamp(at * kMost + 1e-4, 0.0, kMost));
            }
        }
    }
    return sorted(shape);
}

/// As Neuroglancer parts a cell: does no triangle have corners on both sides of a middle plane?
bool lies_in_eighths(const Shape& shape) {
    constexpr std::int64_t kMiddle = 32768;
    return std::ranges::all_of(shape, [](const std::array<Corner, 3>& t) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
            if (least < kMiddle && most > kMiddle) return false;
        }
        return true;
    });
}

Volume oblique_field() {
    Volume volume = make_phantom("random-field", {.size = 24});
    const double c = std::cos(0.4), s = std::sin(0.4);
    volume.info.geometry = {.spacing = {0.7, 1.1, 2.5}, .origin = {-100, 37, 5}, .direction = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}};
    return volume;
}

struct Meshes {
    Volume volume = oblique_field();
    double tau = 0.5;
    OctreeMesh octree = make_octree_mesh(extract(volume, tau), volume.info.geometry, volume.info.extent, {.edge = 8});
};

TEST(PrecomputedMeshes, are_what_the_octree_is) {
    const Folder folder;
    const Meshes meshes;
    PrecomputedMeshes writer(folder / "field.precomputed", meshes.volume.info);
    writer.add("field", meshes.tau, meshes.octree);
    writer.commit();
    const std::string data = read_bytes(folder / "field.precomputed/1");
    Manifest manifest(read_bytes(folder / "field.precomputed/1.index"));
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(manifest.next<float>(), 8);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(manifest.next<float>(), 0);
    const auto levels = manifest.next<std::uint32_t>();
    ASSERT_EQ(levels, meshes.octree.levels.size());
    ASSERT_GE(levels, 3U);
    for (std::uint32_t k = 0; k < levels; ++k) EXPECT_EQ(manifest.next<float>(), 1 << k);
    for (std::uint32_t k = 0; k < 3 * levels; ++k) EXPECT_EQ(manifest.next<float>(), 0);
    for (std::uint32_t k = 0; k < levels; ++k) EXPECT_EQ(manifest.next<std::uint32_t>(), meshes.octree.levels[k].fragments.size());
    std::size_t begin = 0;
    for (std::uint32_t k = 0; k < levels; ++k) {
        const std::vector<OctreeFragment>& fragments = meshes.octree.levels[k].fragments;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const OctreeFragment& fragment : fragments) EXPECT_EQ(manifest.next<std::uint32_t>(), fragment.place[axis]);
        }
        for (const OctreeFragment& fragment : fragments) {
            const auto size = manifest.next<std::uint32_t>();
            const Shape shape = decoded(data.substr(begin, size));
            EXPECT_TRUE(shape == rounded(fragment, std::ldexp(8.0, static_cast<int>(k)))) << k;
            EXPECT_TRUE(k == 0 || lies_in_eighths(shape)) << k;
            begin += size;
        }
    }
    EXPECT_EQ(begin, data.size());
    EXPECT_TRUE(manifest.is_at_end());
}

TEST(PrecomputedMeshes, have_the_space_of_the_volume_in_nanometres) {
    const Folder folder;
    Meshes meshes;
    meshes.volume.info.geometry = {
        .spacing = {2, 3, 4}, .origin = {10, 20, 30}, .direction = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}}, .unit = "µm"};
    PrecomputedMeshes writer(folder / "field.precomputed", meshes.volume.info);
    writer.add("two \"balls\" of 5 \xb5m", 0.25, meshes.octree);
    writer.commit();
    const auto json = [&](const std::string& name) { return nlohmann::json::parse(read_bytes(folder / ("field.precomputed/" + name))); };
    const nlohmann::json info = json("info"), listed = json("segment_properties/info")["inline"];
    EXPECT_EQ(info["@type"], "neuroglancer_multilod_draco");
    EXPECT_EQ(info["vertex_quantization_bits"], 16);
    const std::vector<double> wanted{0, 3e3, 0, 1e4, -2e3, 0, 0, 2e4, 0, 0, 4e3, 3e4};
    for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(info["transform"][i].get<double>(), wanted[i], 1e-9) << i;
    EXPECT_EQ(listed["ids"], nlohmann::json({"1"}));
    EXPECT_EQ(listed["properties"][0]["values"][0], "two \"balls\" of 5 µm");
    EXPECT_EQ(listed["properties"][1]["values"][0], 0.25);
}

TEST(PrecomputedMeshes, appear_whole_or_not_at_all) {
    const Folder folder;
    const Meshes meshes;
    const std::string path = folder / "field.precomputed";
    {
        PrecomputedMeshes writer(path, meshes.volume.info);
        writer.add("field", meshes.tau, meshes.octree);
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
    PrecomputedMeshes writer(path, meshes.volume.info);
    test::expect_helpful(test::failure_of([&] { writer.add("nothing", 0, {.edge = 16, .levels = {}}); }), ErrorKind::usage, "no segment");
    writer.commit();
    test::expect_reason(test::failure_of([&] { PrecomputedMeshes(path, meshes.volume.info); }), ErrorKind::resource,
                        Reason::output_is_folder);
}

}  // namespace
