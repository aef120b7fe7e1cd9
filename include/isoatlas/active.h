// Active objects: the objects and contours at an isovalue, from the trees alone. No sample is read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/shell.h"

namespace isoatlas {

/// A contour as in CutContour, without its hits.
struct ActiveContour {
    std::int64_t id;      ///< index of a voxel: highest of the object (outer), lowest of the cavity (inner)
    std::int64_t object;  ///< id of its object
    Shell shell;
    std::int64_t genus;  ///< 2D: 0
};

/// An object as in CutObject, without what only its voxels determine.
struct ActiveObject {
    std::int64_t id;  ///< index of its highest voxel
    EventId event;    ///< the event whose zone contains tau
    ZoneRange zone;   ///< the isovalues at which it is what it is here: one step down for this object is to zone.tau_low
    double above;     ///< one step up along its largest part: the value of that part's event; zone.tau_high when there is none
    std::int64_t chi, b1, b2;
    std::int64_t min_voxels, max_voxels;  ///< bounds of its voxels; equal when the trees determine them
    std::int64_t contours;                ///< how many it has
    std::int64_t first_contour;           ///< in ActiveObjects::contours: the outer one first, then cavities by id; -1: not requested
};

/// Everything at one isovalue. Objects by descending max_voxels, then ascending id: in the order of Cut when all bounds are equal.
struct ActiveObjects {
    double tau = 0;
    std::vector<ActiveObject> objects;
    std::vector<ActiveContour> contours;  ///< grouped by object, in the order of objects; empty when not requested
    std::int64_t contour_count = 0;
};

struct ActiveOptions {
    bool contours = true;          ///< list the contours, not only count them
    bool integer_samples = false;  ///< all samples are whole numbers: bounds of voxel counts are equal more often
};

/// How the objects of one isovalue lie in those of a lower one.
struct ObjectChanges {
    struct Group {
        std::int64_t lower;               ///< id of an object at the lower isovalue
        std::vector<std::int64_t> upper;  ///< ids of the objects at the higher one that lie in it; none: it appears on the way down
        bool changes;                     ///< more than its extent changes on the way: objects, tunnels or cavities
    };
    std::vector<Group> groups;              ///< by id; those that do not change only on request
    std::int64_t events = 0;                ///< how many events lie between
    std::int64_t appeared = 0, merged = 0;  ///< on the way down: groups without an object above; objects that are lost in a larger one
};

/// A sample: where, and its stored value.
struct VoxelValue {
    std::int64_t voxel = -1;
    double value = 0;
};

/// Index of the active objects of any isovalue. Queries are thread safe.
class ActiveIndex {
public:
    /// The analysis must live as long as this. Cost: O(events) time and 17 bytes an event; the first query for contours O(elements) time
    /// and 13 bytes an element more (ids of 32 bits).
    explicit ActiveIndex(const Analysis& analysis);
    ActiveIndex(ActiveIndex&&) noexcept;
    ActiveIndex& operator=(ActiveIndex&&) noexcept;
    ~ActiveIndex();

    /// The same objects and contours as cut(). Throws Error: usage (tau is not finite), cancelled.
    /// Cost: O((1 + objects + contours) log events). Source: docs/theory/3-trees.md#zones.
    [[nodiscard]] ActiveObjects at(double tau, const ActiveOptions& options = {}, const Context& context = {}) const;

    /// Changes between two isovalues, whichever is higher. all: list also objects that do not change.
    /// Cost: O((1 + objects at both) log events).
    [[nodiscard]] ObjectChanges changes(double tau, double other_tau, bool all = false) const;

    /// The object at tau that contains a maximum of the volume, by its highest voxel. maximum: a voxel and its value, tau or more. Throws
    /// Error: usage (tau is not finite), input (the trees know no such maximum). Cost: O(elements of its value + log events).
    [[nodiscard]] std::int64_t object_of(const VoxelValue& maximum, double tau) const;
    /// The cavity at tau that contains a minimum of the volume, by its lowest voxel. minimum: of a value less than tau. Nothing: it lies
    /// outside of all objects. Throws as object_of(). Cost: the same; the first query for contours as at().
    [[nodiscard]] std::optional<std::int64_t> cavity_of(const VoxelValue& minimum, double tau) const;

    /// The next isovalue up or down at which something happens anywhere, as the highest isovalue of what comes then: down, the value of the
    /// next event; up, that of the event before the last one. Nothing: no event is left on that side. Cost: O(log events).
    [[nodiscard]] std::optional<double> event_below(double tau) const;
    [[nodiscard]] std::optional<double> event_above(double tau) const;

    struct Data;

private:
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
