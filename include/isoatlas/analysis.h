// Analysis: every topological change of a volume, exactly: criticality tree, contour tree, genus, zones.
//
// Terms: tau is an isovalue. A sample is High at tau when value >= tau. An *object* is a connected set of Highs, a *low component* a
// connected set of Lows (everything outside the volume is Low), a *contour* the closed surface between one object and one low component.
// Three views of the same changes, from fine to coarse (docs/theory/3-trees.md#equal-values):
//   elements  critical voxels and face points, in the symbolic order; ties between equal values are broken by voxel number
//   levels    elements of one value that touch the same contours, contracted: independent of voxel numbering
//   events    levels of one value in one object, contracted: the nodes of the criticality tree; between events nothing changes
// All values here are *stored* values (see Calibration); ids are stable for one volume and the same for any thread count.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "isoatlas/criticality.h"
#include "isoatlas/id.h"
#include "isoatlas/interpolant.h"
#include "isoatlas/volume.h"

namespace isoatlas {

enum class ElementKind : std::uint8_t { vertex, face, body };

/// A critical element: where (voxel coordinates; a face point has two .5 coordinates, a body point three: the centre of its cell), and how
/// many objects (h0) meet it just above and how many low components (l0) just below. 3D: (0,1) maximum, (2,1), (1,2), (1,0) minimum; 2D:
/// saddles are (2,2).
struct Element {
    double value;
    std::array<double, 3> position;
    int h0, l0;
    ElementKind kind;
};

/// A level: the genera of the contours that arrive from above and leave below, sorted. Only non-trivial ones are kept.
struct Level {
    double value;
    EventId event;                      ///< the event it belongs to
    std::vector<std::int64_t> in, out;  ///< genus of each contour just above / just below
};

/// An arc of the contour tree: one contour while it lives, for tau in (value_low, value_high].
struct ContourArc {
    ElementId upper, lower;  ///< its ends; lower == ElementId(element_count()): the outside of the volume
    double value_high, value_low;
    std::int64_t genus;
};

/// Isovalue interval (tau_low, tau_high]; tau_low is -infinity for the root.
struct ZoneRange {
    double tau_low, tau_high;
    std::int64_t voxels;  ///< samples whose value lies in the interval inside this object: they form the zone
};

/// A node of the criticality tree: at `value`, topology of one object changes. Its zone is the interval below it in which nothing changes.
struct Event {
    EventId id;
    double value;
    std::array<double, 3> position;  ///< voxel coordinates of its highest critical element
    Criticality kind;
    EventId parent;                     ///< next event of the same object going down; none: root
    std::span<const EventId> children;  ///< the events (objects) that arrive here from above; valid while the Analysis lives
    std::int64_t objects_in;            ///< number of children
    std::int64_t lows_out;              ///< low components that leave the event's levels just below
    std::int64_t delta_chi;             ///< change of the Euler characteristic of the High set
    ZoneRange zone;
    std::int64_t chi, b1, b2;    ///< of the object inside the zone (b0 = 1); 2D: b2 = 0
    std::int64_t contours;       ///< number of contours of the object inside the zone
    std::int64_t object_voxels;  ///< voxels of the object at the low end of the zone (just above tau_low)
};

/// How many contours of one genus an object has.
struct GenusCount {
    std::int64_t genus, count;
};

struct AnalysisOptions {
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;  ///< trilinear: tunnels of at most this height (difference of stored values) are left out
    bool zones = true;         ///< label every voxel with its zone (needed for voxel counts); false: trees only
};

class Analysis {
public:
    struct Data;
    explicit Analysis(std::unique_ptr<Data> data);
    Analysis(Analysis&&) noexcept;
    Analysis& operator=(Analysis&&) noexcept;
    ~Analysis();

    [[nodiscard]] const Extent& extent() const;
    [[nodiscard]] Interpolant interpolant() const;
    [[nodiscard]] double tunnel_height() const;  ///< of AnalysisOptions

    /// Critical elements in descending order of the total order; id = position in this order.
    [[nodiscard]] std::int64_t element_count() const;
    [[nodiscard]] Element element(ElementId id) const;

    /// Arcs of the contour tree between elements of different value (zero-length arcs are contracted into levels).
    [[nodiscard]] std::int64_t contour_arc_count() const;
    [[nodiscard]] ContourArc contour_arc(std::int64_t id) const;

    /// Non-trivial levels, in descending order of their highest element.
    [[nodiscard]] std::int64_t level_count() const;
    [[nodiscard]] Level level(std::int64_t id) const;

    /// Events in descending order: children have smaller ids than their parent; the last one is the root.
    [[nodiscard]] std::int64_t event_count() const;
    [[nodiscard]] Event event(EventId id) const;
    /// Calls visit(event, genus histogram of the contours of its object inside its zone, ascending genus) for every event in id order.
    /// Cost: O(events + levels) plus what is visited.
    void visit_object_contours(const std::function<void(EventId, std::span<const GenusCount>)>& visit) const;

    /// Are the voxels of zones and objects counted? (Made with zones, or read from a store.)
    [[nodiscard]] bool counts_voxels() const;
    /// The zone of a voxel: the event e with value(parent(e)) < value(voxel) <= value(e) in the voxel's object.
    /// Throws Error{usage} when the analysis was made without zones, or read from a store.
    [[nodiscard]] EventId zone(VoxelId voxel) const;

    [[nodiscard]] const Data& data() const { return *data_; }
    [[nodiscard]] Data& data() { return *data_; }

private:
    std::unique_ptr<Data> data_;
};

/// The whole engine: classify, sort the critical elements, join and split tree, contour tree, genus, events, zones.
/// Cost: O(voxels + c log c) time for c critical elements; memory at most 12 bytes a voxel plus 64 bytes a critical element
/// beyond the samples, and some 40 MB whatever the size. Source: docs/theory/README.md.
[[nodiscard]] Analysis analyse(const Volume& volume, const AnalysisOptions& options = {}, const Context& context = {});

}  // namespace isoatlas
