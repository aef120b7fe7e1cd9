#include "formats/mesh/draco_mesh.h"

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include "base/check.h"

namespace isoatlas {
namespace {

void fill_mesh(draco::Mesh& mesh, std::span<const std::array<std::int32_t, 3>> points,
               std::span<const std::array<std::uint32_t, 3>> triangles) {
    mesh.set_num_points(static_cast<std::uint32_t>(points.size()));
    mesh.SetNumFaces(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        mesh.SetFace(draco::FaceIndex(i), {draco::PointIndex(a), draco::PointIndex(b), draco::PointIndex(c)});
    }
    draco::GeometryAttribute position;
    position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_INT32, false, sizeof(points[0]), 0);
    const int id = mesh.AddAttribute(position, true, static_cast<std::uint32_t>(points.size()));
    for (std::uint32_t i = 0; i < points.size(); ++i)
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), points[i].data());
}

}  // namespace

std::vector<std::byte> draco_mesh(std::span<const std::array<std::int32_t, 3>> points,
                                  std::span<const std::array<std::uint32_t, 3>> triangles) {
    constexpr int kSpeed = 3;  // 0: smallest, 10: fastest
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    encoder.SetSpeedOptions(kSpeed, kSpeed);
    draco::EncoderBuffer buffer;
    draco::Mesh mesh;
    fill_mesh(mesh, points, triangles);
    ISOATLAS_CHECK(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    const auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
    return {bytes.begin(), bytes.end()};
}

}  // namespace isoatlas
