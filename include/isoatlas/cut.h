// Cut: all objects, low components and contours of one volume at one isovalue, without any tree. O(volume) time.
//
// Ids: an object at tau is identified by the index of its highest voxel (ties: the larger index wins), a low component by the index of its
// lowest voxel (ties: the smaller index wins), so the same id stays valid while the isovalue moves and the object lives. Every object has
// exactly one outer contour (towards the outside), every low component except the outside has exactly one
// contour towards the outside too (the wall of a cavity): a contour is identified by the object (outer) or by the low component (inner).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/shell.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct CutContour {
    std::int64_t id;      ///< index of a voxel: highest of the object (outer), lowest of the cavity (inner)
    std::int64_t object;  ///< id of its object
    Shell shell;
    std::int64_t genus;  ///< 2D: 0
    std::int64_t hits;   ///< crossed grid edges (edges to the padding included)
};

struct CutObject {
    std::int64_t id;           ///< index of its highest voxel
    std::int64_t chi, b1, b2;  ///< b0 = 1; b2 = number of cavities in 3D; 2D: b1 = number of holes, b2 = 0
    std::int64_t voxels;
    double measure;                             ///< physical volume (area in 2D): sum of voxel boxes
    Index3 box_low, box_high;                   ///< inclusive voxel bounds
    std::int64_t first_contour, contour_count;  ///< range in Cut::contours: the outer one first, then cavities by id
};

/// Everything at one isovalue. Objects by descending voxel count, then ascending id.
struct Cut {
    double tau;
    Interpolant interpolant;
    double tunnel_height;  ///< of CutOptions
    std::vector<CutObject> objects;
    std::vector<CutContour> contours;  ///< grouped by object, in the order of objects
    std::int64_t active_cells;         ///< cells the surface passes through (padding cells included)
    /// Position in `objects` of the object of each voxel, -1 for Lows. Empty unless requested.
    std::vector<std::int32_t> label;
};

struct CutOptions {
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;  ///< trilinear: tunnels of at most this height (difference of stored values) are left out
    bool label = false;        ///< fill Cut::label (4 bytes a voxel)
};

/// tau is a stored value. Any finite tau: above the maximum there are no objects, at or below the minimum there is one.
[[nodiscard]] Cut cut(const Volume& volume, double tau, const CutOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
