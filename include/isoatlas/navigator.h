// Navigator: incremental extraction along the isovalues of a store, for viewers.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "isoatlas/active.h"
#include "isoatlas/atlas.h"
#include "isoatlas/surface.h"

namespace isoatlas {

struct FrontOptions;  // isoatlas/octree_front.h
struct FrontSurface;

/// An isovalue of a store and its surface. A move costs less than a new query: samples that are present stay, only bricks that have a
/// sample between the two isovalues are classified again, and the memory of the surface is used again. One thread at a time; several
/// Navigators may use one Atlas at once.
class Navigator {
public:
    /// The atlas must live as long as this. options: as for Atlas::extract(); objects select what is shown, see show(). Reads nothing.
    explicit Navigator(const Atlas& atlas, const SurfaceOptions& options = {});
    Navigator(Navigator&&) noexcept;
    Navigator& operator=(Navigator&&) noexcept;
    ~Navigator();

    /// Empty before the first move, and after one that threw.
    [[nodiscard]] std::optional<double> tau() const;
    /// The surface at tau(): the same bytes as Atlas::extract(tau(), options). Valid until the next move.
    [[nodiscard]] const Surface& surface() const;

    /// Moves to an isovalue. Any finite tau. Throws what Atlas::extract() throws.
    const Surface& go_to(double tau, const Context& context = {});
    /// Moves by a difference, up or down. Throws Error{usage} before the first go_to().
    const Surface& step(double delta, const Context& context = {});
    /// Shows some objects only (any voxel index in each, as in SurfaceOptions; none: all) at an isovalue, and from then on.
    const Surface& show(std::vector<std::int64_t> objects, double tau, const Context& context = {});

    /// Moves to an isovalue, and makes its octree front in place of the exact surface: surface() is empty until the next move. The same as
    /// Atlas::extract_front(tau, front, options), and throws what that throws.
    [[nodiscard]] FrontSurface extract_front(double tau, const FrontOptions& front, const Context& context = {});

    /// Moves to the next isovalue at which something happens: with one object shown by its id (its highest voxel), to this object, else
    /// anywhere. Downwards that is the value of the next event, where it has just happened; upwards that of the event before the last one,
    /// where the last one has not happened yet. False, and nothing moves: there is none on that side. Cost: the first call reads the trees.
    bool to_event_below(const Context& context = {});
    bool to_event_above(const Context& context = {});

    /// What the last move changed, by the trees: how the objects of the higher isovalue lie in those of the lower one. Nothing changes in a
    /// first move. Cost: the first call reads the trees; O((1 + objects at both) log events).
    [[nodiscard]] ObjectChanges changes() const;
    /// Cost of the last move. The first call after a move counts the active cells: O(voxels / 64) at most.
    [[nodiscard]] const QueryCost& cost() const;
    /// Number of bricks that the last move classified again.
    [[nodiscard]] std::int64_t changed_bricks() const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
