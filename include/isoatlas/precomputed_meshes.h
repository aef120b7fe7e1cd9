// Meshes for Neuroglancer: a folder in its precomputed format, with levels of detail.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "isoatlas/octree_mesh.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Names of folders that are written so.
inline constexpr const char* kPrecomputedExtension = ".precomputed";

/// Writes a folder of multi-resolution meshes ("neuroglancer_multilod_draco", unsharded, positions of 16 bits) with segment_properties:
/// `info`, and of every segment its manifest `N.index` and its fragments `N`. Points of level k are rounded to 2^k edge / 65535 voxels; the
/// levels of a mesh have the same points in common before, so that gaps between neighbours of different levels are no wider than that.
/// The model space is the space of the volume in nanometres (unknown units count as millimetres).
/// Source: Neuroglancer, "Mesh representation of segmented object surfaces"; Draco encodes the fragments.
class PrecomputedMeshes {
public:
    /// The folder appears with commit(), whole. Throws Error{resource}: something is there already, or it cannot be written.
    PrecomputedMeshes(const std::string& path, const VolumeInfo& info);
    PrecomputedMeshes(const PrecomputedMeshes&) = delete;
    PrecomputedMeshes& operator=(const PrecomputedMeshes&) = delete;
    ~PrecomputedMeshes();

    /// The next segment: 1, 2 ... in the order of calls. reported_tau: a property of it, as the label is. Throws Error: resource, usage (a
    /// mesh without triangles). Cost: about 1 us and 2 to 4 bytes a triangle of all levels.
    void add(const std::string& label, double reported_tau, const OctreeMesh& mesh);
    /// Nothing may be added afterwards.
    void commit();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
