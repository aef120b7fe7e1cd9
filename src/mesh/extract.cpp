#include <algorithm>
#include <cmath>
#include <optional>

#include "base/big_vector.h"
#include "critical/bodies.h"
#include "field/slab_work.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "mesh/cells.h"
#include "mesh/count_cells.h"
#include "mesh/extract_level.h"
#include "mesh/hits.h"
#include "mesh/keep_contours.h"
#include "mesh/select_cells.h"
#include "mesh/squares.h"

namespace isoatlas {
namespace {

template <class Visit>
void for_arrays(Surface& surface, Visit&& visit) {
    visit(surface.points), visit(surface.normals), visit(surface.triangles), visit(surface.segments), visit(surface.object),
        visit(surface.contour);
}

template <class T>
class Extraction {
public:
    Extraction(const TauLevel& level, const SampleGrid<T>& grid, const ExtractOptions& how, const Context& context,
               const Components* components)
        : grid_{grid.samples, grid.extent, grid.layout, level.window ? level.window->origin : Index3{}},
          tau_(level.tau),
          options_(how.surface),
          context_(context),
          components_(components),
          domain_(level.high, how.surface.boundary),
          groups_(domain_),
          map_(level.info().geometry, level.window ? level.window->whole : level.info().extent),
          flip_(is_mirrored(level.info())),
          cells_(grid_, level.tau, domain_, map_, how, flip_) {}

    /// Returns what is made.
    ExtractionParts run(const PartsWanted& wanted, Surface& surface) {
        if (domain_.is_empty()) {
            for_arrays(surface, [](auto& array) { array.clear(); });
            return wanted(0);
        }
        count();
        const ExtractionParts parts = wanted(layout_.back().triangle);
        if (parts == ExtractionParts::none) return parts;
        require_triangles(layout_.back().triangle, options_);
        if (parts == ExtractionParts::hits) leave_hits();
        allocate(surface);
        write_hits(surface);
        if (parts == ExtractionParts::all) write_cells(surface);
        return parts;
    }

private:
    void prefetch_group(std::int64_t group, std::int64_t z) const {
        const auto [begin, end] = RowGroups::rows(domain_, group);
        const std::int64_t end_inside = std::min(end, grid_.extent.size[1]);
        if (z < domain_.z_end && begin >= 0 && begin < end_inside && !domain_.high.candidates(begin, z).empty())
            prefetch_rows(domain_, layout_, begin, end_inside, z);
    }
    /// Calls visit(group, z) for all groups of rows of points: slab by slab, and in a slab those whose samples lie near each other.
    template <class Visit>
    void for_groups(const Phase& phase, const Visit& visit) {
        if (domain_.is_2d()) {
            for_each_slab(context_, phase, {groups_.end() - groups_.begin(), RowGroups::kSide * grid_.extent.size[0]},
                          [&](const Slab& slab) {
                              for (std::int64_t i = slab.z_begin; i < slab.z_end; ++i) visit(groups_.begin() + i, domain_.z_begin);
                          });
            return;
        }
        for_each_slab(context_, phase, {domain_.rows_z(), grid_.extent.slice()}, [&](const Slab& slab) {
            for (std::int64_t group = groups_.begin(); group < groups_.end(); ++group) {
                for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
                    prefetch_group(group, domain_.z_begin + z + kSlicesAhead);
                    visit(group, domain_.z_begin + z);
                }
            }
        });
    }
    /// Calls visit(y, z, found) for the rows of the groups that are used; found: the number of a group's next cell that is not plain.
    template <class Visit>
    void for_used_rows(const Phase& phase, const Visit& visit) {
        for_groups(phase, [&](std::int64_t group, std::int64_t z) {
            if (!groups_.is_used(group, z)) return;
            const auto [begin, end] = RowGroups::rows(domain_, group);
            const std::uint8_t* found = groups_.found(group, z).data();
            for (std::int64_t y = begin; y < end; ++y) visit(y, z, found);
        });
    }
    [[nodiscard]] bool has_cells(std::int64_t y, std::int64_t z) const {
        return y < domain_.y_end && (domain_.is_2d() || z < domain_.z_end);
    }

    /// PASS 1 and 2.
    void count() {
        resize_for_overwrite(layout_, static_cast<std::size_t>(domain_.rows_y() * domain_.rows_z() + 1));
        for_groups(kSurfacePhases["count"], [&](std::int64_t group, std::int64_t z) {
            const auto [begin, end] = RowGroups::rows(domain_, group);
            bool used = false;
            std::vector<std::uint8_t>& found = groups_.found(group, z);
            for (std::int64_t y = begin; y < end; ++y) used |= count_row(y, z, found);
            if (used) groups_.use(group, z);
        });
        layout_.back() = {};
        exclusive_scan_counts(layout_);
    }
    /// PASS 1 of a row. Returns whether it has hits or triangles.
    bool count_row(std::int64_t y, std::int64_t z, std::vector<std::uint8_t>& found) {
        RowOffsets& place = layout_[domain_.row_number(y, z)];
        place = {};
        if (domain_.high.candidates(y, z).empty()) return false;
        if (domain_.is_2d() || !has_cells(y, z)) {
            count_hits(domain_, y, z, place);
            if (has_cells(y, z)) place.triangle = count_segments(domain_, y);
        } else {
            cells_.count_row(y, z, place, found);
        }
        return place.x_hits + place.y_hits + place.z_hits + place.triangle > 0;
    }

    /// Offsets of hits alone, in place of those of PASS 2.
    void leave_hits() {
        std::int64_t point = 0;
        for (RowOffsets& place : layout_) {
            place.point = point, place.triangle = 0, place.articulation_points = 0;
            point += std::int64_t{place.x_hits} + place.y_hits + place.z_hits;
        }
    }

    /// Every entry will be written.
    void allocate(Surface& surface) const {
        const auto points = static_cast<std::size_t>(layout_.back().point), simplices = static_cast<std::size_t>(layout_.back().triangle);
        resize_for_overwrite(surface.segments, domain_.is_2d() ? simplices : 0);
        resize_for_overwrite(surface.triangles, domain_.is_2d() ? 0 : simplices);
        resize_for_overwrite(surface.points, points);
        resize_for_overwrite(surface.normals, options_.normals ? points : 0);
        resize_for_overwrite(surface.contour, components_ != nullptr ? points : 0);
    }

    /// PASS 3.
    void write_hits(Surface& surface) {
        const HitWriter<T> hits(grid_, tau_, map_, domain_, surface);
        const Phase phase = kSurfacePhases["points"];
        for_each_slab_of(1, context_, phase, hits.bundles(), [&](const Slab& bundle) { hits.write(bundle.z_begin, layout_, groups_); });
        for_used_rows(phase, [&](std::int64_t y, std::int64_t z, const std::uint8_t*) {
            const RowOffsets& place = layout_[domain_.row_number(y, z)];
            if (place.x_hits + place.y_hits + place.z_hits == 0) return;
            if (y < 0 || z < 0) hits.write_outside(y, z, place);
            if (components_ != nullptr) write_contours(*components_, domain_, y, z, place, surface);
        });
    }

    /// PASS 4.
    void write_cells(Surface& surface) {
        for_used_rows(kTrianglePhases["triangles"], [&](std::int64_t y, std::int64_t z, const std::uint8_t*& found) {
            if (!has_cells(y, z)) return;
            if (domain_.is_2d())
                write_segments(grid_, tau_, domain_, y, layout_, flip_, surface);
            else
                cells_.write_row(y, z, layout_, found, surface);
        });
    }

    SampleGrid<T> grid_;
    double tau_;
    const SurfaceOptions& options_;
    const Context& context_;
    const Components* components_;
    MeshDomain domain_;
    RowGroups groups_;
    PhysicalMap map_;
    bool flip_;
    CellWriter<T> cells_;
    Layout layout_;
};

}  // namespace

bool is_mirrored(const VolumeInfo& info) {
    const Mat3& m = info.geometry.direction;
    const double in_plane = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (info.extent.rank == 2 && std::abs(in_plane) > 1e-12) return in_plane < 0;
    return handedness(info.geometry) < 0;
}

bool selects_components(const SurfaceOptions& options) {
    return !options.objects.empty() || !options.contours.empty() || options.shell != ShellChoice::all;
}

void describe(Surface& surface, const VolumeInfo& info, double tau, Interpolant interpolant, double tunnel_height) {
    surface.tau = tau;
    surface.reported_tau = info.calibration.reported(tau);
    surface.space = info.geometry.space;
    surface.unit = info.geometry.unit;
    surface.interpolant = interpolant;
    surface.tunnel_height = tunnel_height;
    surface.reported_tunnel_height = info.calibration.reported_difference(tunnel_height);
    surface.polarity = polarity_of(info);
}

void require_triangles(std::int64_t triangles, const SurfaceOptions& options, const char* about) {
    if (options.max_triangles == 0 || triangles <= options.max_triangles) return;
    throw Error(ErrorKind::resource, {.what = "the surface has " + std::string(about) + std::to_string(triangles) + " triangles",
                                      .expected = "at most " + std::to_string(options.max_triangles),
                                      .next = "ask for one object or another isovalue, or allow more triangles",
                                      .reason = Reason::too_many_triangles});
}

Surface extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context) {
    Surface surface;
    extract_level(level, options, context, surface);
    return surface;
}

void extract_level(const TauLevel& level, const ExtractOptions& how, const Context& context, Surface& surface, std::int64_t* cells) {
    const auto always = [](std::int64_t) { return ExtractionParts::all; };
    extract_parts(always, level, how, choose_components(level, how, context), context, surface, cells);
}

ExtractionParts extract_parts(const PartsWanted& wanted, const TauLevel& level, const ExtractOptions& how,
                              const ChosenComponents& components, const Context& context, Surface& surface, std::int64_t* cells) {
    const SurfaceOptions& options = how.surface;
    describe(surface, level.info(), level.tau, how.interpolant, how.tunnel_height);
    surface.closed = options.boundary == Boundary::closed;

    ExtractionParts made = ExtractionParts::none;
    visit_grid(level.volume, [&]<class T>(const SampleGrid<T>& grid) {
        made = Extraction<T>(level, grid, how, context, components.get()).run(wanted, surface);
    });
    if (made == ExtractionParts::none) return made;
    const bool selects = !components.contours.empty();
    if (cells != nullptr) {
        *cells = selects ? count_cells(level, options.boundary, *components.all, components.contours, context)
                         : count_cells(level, options.boundary, context);
    }
    if (made == ExtractionParts::hits) return made;
    if (selects) keep_contours(components.contours, context, surface);
    if (options.ids)
        write_ids(*components.all, context, surface);
    else
        surface.object.clear(), surface.contour.clear();
    return made;
}

Surface extract(const Volume& volume, double tau, const ExtractOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    const HighBits high = classify(volume, tau, context);
    return extract_level({volume, tau, high}, options, context);
}

}  // namespace isoatlas
