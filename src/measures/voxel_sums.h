// Sums over the voxels of objects: counts, values, moments. Added run by run; the samples may come slab by slab.
//
// Sums of a slice (2D: of kRowsTogether rows) are added up on one thread and then to those before, in the order of the slices: the result
// depends neither on threads nor on slabs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/filter.h"
#include "isoatlas/measures.h"
#include "levelset/components.h"
#include "measures/voxel_boxes.h"

namespace isoatlas {

/// Of some voxels of one object. Places are relative to a point near the object.
struct VoxelSums {
    std::int64_t voxels = 0;
    double weight = 0;             ///< sum of the products of widths
    Vec3 first{};                  ///< of weight * place
    std::array<double, 6> second;  ///< of weight * place * place: xx yy zz xy xz yz, of all points of the boxes
    double mean = 0;               ///< of stored values, by weight
    double squares = 0;            ///< sum of weight * squared difference from the mean
    double sum = 0, min = 0, max = 0;

    VoxelSums() : second{} {}
    /// Means are combined as in Chan, Golub, LeVeque: Updating formulae and a pairwise algorithm for computing sample variances, 1979.
    void add(const VoxelSums& other);
};

/// Where an object lies.
struct ObjectPlace {
    std::int64_t id = -1;
    std::int64_t voxels = 0;
    SampleBox box{};
};

class MeasuredVoxels {
public:
    /// Of all objects together, as one with the number of the first.
    MeasuredVoxels(const VolumeInfo& info, const Components& components);
    /// Of those objects that contain one of these voxels, all of them High; empty: of all. components: of the volume, or of the part of it
    /// that begins at `origin` and holds the objects.
    MeasuredVoxels(const VolumeInfo& info, const Components& components, std::span<const std::int64_t> voxels, const Index3& origin = {});

    [[nodiscard]] std::size_t size() const { return places_.size(); }
    [[nodiscard]] const ObjectPlace& place(std::size_t object) const { return places_[object]; }
    /// Of all objects together.
    [[nodiscard]] const SampleBox& box() const { return box_; }

    /// Adds the samples of whole slices of box(), in their order. part: the samples in memory, x fastest; slices: which of them to add.
    void add(std::span<const std::byte> samples, const SampleBox& part, const Context& context);

    /// Voxels, values, centroid and axes of an object.
    void describe(std::size_t object, ObjectMeasures& measures) const;

private:
    struct Part;
    void find_places();
    template <class T>
    void add_unit(const T* samples, const SampleBox& part, std::int64_t unit, Part& sums) const;
    template <class T>
    void add_run(const T* row, const Index3& begin, std::int64_t end, const Vec3& reference, VoxelSums& sums) const;

    const VolumeInfo& info_;
    const Components& components_;
    Index3 origin_;
    VoxelBoxes boxes_;
    std::vector<std::int32_t> object_;  ///< by ObjectNumber: position here, -1: none
    std::vector<ObjectPlace> places_;
    std::vector<Vec3> reference_;  ///< middle of the object's box
    std::vector<VoxelSums> sums_;
    SampleBox box_{};
};

}  // namespace isoatlas
