#include <cmath>
#include <optional>

#include "base/parallel.h"
#include "critical/bodies.h"
#include "field/slab_work.h"
#include "mesh/cells.h"
#include "mesh/count_cells.h"
#include "mesh/extract_level.h"
#include "mesh/hits.h"
#include "mesh/huge_pages.h"
#include "mesh/selection.h"
#include "mesh/squares.h"

namespace isoatlas {
namespace {

constexpr int kPhases = 3;

/// Must triangles (segments) turn the other way round than in voxel coordinates? A 2D image is seen from +z where it can be.
bool is_mirrored(const VolumeInfo& info) {
    const Mat3& m = info.geometry.direction;
    const double in_plane = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (info.extent.rank == 2 && std::abs(in_plane) > 1e-12) return in_plane < 0;
    return handedness(info.geometry) < 0;
}

template <class Visit>
void for_arrays(Surface& surface, Visit&& visit) {
    visit(surface.points), visit(surface.normals), visit(surface.triangles), visit(surface.segments), visit(surface.object),
        visit(surface.contour);
}

template <class T>
class Extraction {
public:
    Extraction(const TauLevel& level, std::span<const T> samples, const ExtractOptions& options, const Context& context,
               const Components* components)
        : grid_{samples.data(), level.info().extent, level.window ? level.window->origin : std::array<std::int64_t, 3>{}},
          tau_(level.tau),
          options_(options),
          context_(context),
          components_(components),
          domain_(level.high, options.boundary),
          map_(level.info().geometry, level.window ? level.window->whole : level.info().extent),
          flip_(is_mirrored(level.info())),
          cells_(grid_, level.tau, domain_, map_, options, flip_) {}

    void run(Surface& surface) {
        if (domain_.is_empty()) return for_arrays(surface, [](auto& array) { array.clear(); });
        count();
        allocate(surface);
        write_hits(surface);
        write_cells(surface);
    }

private:
    /// Calls visit(y, z) for all rows of points, slab by slab.
    template <class Visit>
    void for_rows(const Phase& phase, Visit&& visit) {
        Extent rows = grid_.extent;
        rows.size = {rows.size[0], domain_.rows_y(), domain_.rows_z()};
        for_each_row(context_, phase, rows, [&](std::int64_t y, std::int64_t z) { visit(domain_.y_begin + y, domain_.z_begin + z); });
    }
    [[nodiscard]] bool has_cells(std::int64_t y, std::int64_t z) const {
        return y < domain_.y_end && (domain_.is_2d() || z < domain_.z_end);
    }

    void count() {
        resize_fresh(layout_, static_cast<std::size_t>(domain_.rows_y() * domain_.rows_z() + 1));
        for_rows({"count", 1, kPhases}, [&](std::int64_t y, std::int64_t z) {
            if (domain_.high.busy(y, z).empty()) return;
            RowPlace& place = layout_[domain_.row_number(y, z)];
            count_hits(domain_, y, z, place);
            if (!has_cells(y, z)) return;
            if (domain_.is_2d())
                place.triangle = count_segments(domain_, y);
            else
                cells_.count_row(y, z, place);
        });
        turn_counts_into_places(layout_);
    }

    /// The arrays are filled with zeros while they grow: one thread each. Every entry will be written.
    void allocate(Surface& surface) const {
        const auto points = static_cast<std::size_t>(layout_.back().point), simplices = static_cast<std::size_t>(layout_.back().triangle);
        for_each_block(context_.threads, 4, [&](std::int64_t array) {
            if (array == 0) {
                resize_fresh(surface.segments, domain_.is_2d() ? simplices : 0);
                resize_fresh(surface.triangles, domain_.is_2d() ? 0 : simplices);
            }
            if (array == 1) resize_fresh(surface.points, points);
            if (array == 2) resize_fresh(surface.normals, options_.normals ? points : 0);
            if (array == 3) resize_fresh(surface.contour, components_ != nullptr ? points : 0);
        });
    }

    void write_hits(Surface& surface) {
        const HitWriter<T> hits(grid_, tau_, map_, domain_, surface);
        for_rows({"points", 2, kPhases}, [&](std::int64_t y, std::int64_t z) {
            const RowPlace& place = layout_[domain_.row_number(y, z)];
            if (place.x_hits + place.y_hits + place.z_hits == 0) return;
            hits.write_row(y, z, place);
            if (components_ != nullptr) write_contours(*components_, domain_, y, z, place, surface);
        });
    }

    void write_cells(Surface& surface) {
        for_rows({"triangles", 2, kPhases}, [&](std::int64_t y, std::int64_t z) {
            if (!has_cells(y, z)) return;
            if (domain_.is_2d())
                write_segments(grid_, tau_, domain_, y, layout_, flip_, surface);
            else
                cells_.write_row(y, z, layout_, surface);
        });
    }

    GridView<T> grid_;
    double tau_;
    const ExtractOptions& options_;
    const Context& context_;
    const Components* components_;
    MeshDomain domain_;
    PhysicalMap map_;
    bool flip_;
    CellWriter<T> cells_;
    Layout layout_;
};

}  // namespace

Surface extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context) {
    Surface surface;
    extract_level(level, options, context, surface);
    return surface;
}

void extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context, Surface& surface, std::int64_t* cells) {
    const VolumeInfo& info = level.info();
    surface.tau = level.tau;
    surface.reported_tau = info.calibration.reported(level.tau);
    surface.space = info.geometry.space;
    surface.unit = info.geometry.unit;
    surface.closed = options.boundary == Boundary::closed;
    surface.interpolant = options.interpolant;
    surface.tunnel_height = options.tunnel_height;
    surface.reported_tunnel_height = info.calibration.reported_difference(options.tunnel_height);

    const bool selects = !options.objects.empty() || !options.contours.empty() || options.shell != ShellChoice::all;
    std::optional<Components> components;
    if (selects || options.ids) components = find_components(level, tunnel_height_of(options.interpolant, options.tunnel_height), context);
    const std::vector<std::uint8_t> chosen = selects ? chosen_contours(level, *components, options) : std::vector<std::uint8_t>{};
    visit_samples(level.volume, [&](auto samples) {
        using T = typename decltype(samples)::value_type;
        Extraction<T>(level, samples, options, context, components ? &*components : nullptr).run(surface);
    });
    if (cells != nullptr) {
        *cells =
            selects ? count_cells(level, options.boundary, *components, chosen, context) : count_cells(level, options.boundary, context);
    }
    if (selects) keep_contours(chosen, surface);
    if (options.ids)
        write_ids(*components, context, surface);
    else
        surface.object.clear(), surface.contour.clear();
}

Surface extract(const Volume& volume, double tau, const ExtractOptions& options, const Context& context) {
    const HighBits high = classify(volume, tau, context);
    return extract_level({volume, tau, high}, options, context);
}

}  // namespace isoatlas
