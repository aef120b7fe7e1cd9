#include "measures/convex_hull.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <unordered_map>

#include <libqhull_r/qhull_ra.h>

#include "measures/vectors.h"

namespace isoatlas {
namespace {

/// Maps points to about the cube of edge 1 around the origin, axis by axis: an affine map, which maps hulls to hulls. Keeps thin and tiny
/// objects away from the rounding of Qhull.
struct UnitCube {
    Vec3 middle{}, size{1, 1, 1};

    explicit UnitCube(std::span<const Vec3> points) {
        Vec3 low = points[0], high = points[0];
        for (const Vec3& p : points) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], p[axis]);
                high[axis] = std::max(high[axis], p[axis]);
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            middle[axis] = low[axis] + (high[axis] - low[axis]) / 2;
            if (high[axis] > low[axis]) size[axis] = high[axis] - low[axis];
        }
    }
    [[nodiscard]] double coordinate(const Vec3& p, std::size_t axis) const { return (p[axis] - middle[axis]) / size[axis]; }
    /// Of a plane with that normal in the cube.
    [[nodiscard]] Vec3 normal(const double* inside, std::size_t rank) const {
        Vec3 n{};
        for (std::size_t axis = 0; axis < rank; ++axis) n[axis] = inside[axis] / size[axis];
        return unit(n);
    }
};

/// Messages of Qhull go into memory and are dropped.
class Messages {
public:
    Messages() : stream_(::open_memstream(&text_, &size_)) {}
    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;
    ~Messages() {
        if (stream_ != nullptr) (void)std::fclose(stream_);
        std::free(text_);  // NOLINT(cppcoreguidelines-no-malloc): of open_memstream
    }
    [[nodiscard]] std::FILE* stream() const { return stream_; }

private:
    char* text_ = nullptr;
    std::size_t size_ = 0;
    std::FILE* stream_;
};

/// One run of Qhull.
class Quickhull {
public:
    Quickhull(std::vector<double>& coordinates, int rank, const char* options) {
        if (messages_.stream() == nullptr) throw Error(ErrorKind::resource, {.what = "not enough memory"});
        qh_zero(&state_, messages_.stream());
        std::string command(options);  // Qhull takes it as char*
        const auto count = static_cast<int>(coordinates.size() / static_cast<std::size_t>(rank));
        failed_ = qh_new_qhull(&state_, rank, count, coordinates.data(), False, command.data(), nullptr, messages_.stream()) != 0;
    }
    Quickhull(const Quickhull&) = delete;
    Quickhull& operator=(const Quickhull&) = delete;
    ~Quickhull() {
        qh_freeqhull(&state_, !qh_ALL);
        int left = 0, blocks = 0;
        qh_memfreeshort(&state_, &left, &blocks);
    }
    [[nodiscard]] bool failed() const { return failed_; }

    /// Calls visit(ids of its vertices, normal) for every facet.
    template <class Visit>
    void for_each_facet(std::size_t rank, const Visit& visit) {
        qhT* const qh = &state_;  // the macros of Qhull name it
        facetT* facet = nullptr;
        vertexT *vertex = nullptr, **vertexp = nullptr;
        FORALLfacets {
            std::array<std::int32_t, 3> ids{};
            std::size_t count = 0;
            FOREACHvertex_(facet->vertices) {
                if (count < rank) ids[count] = qh_pointid(qh, vertex->point);
                ++count;
            }
            if (count == rank) visit(ids, facet->normal);
        }
    }

private:
    Messages messages_;
    qhT state_{};
    bool failed_ = true;
};

std::vector<double> coordinates_of(std::span<const Vec3> points, const UnitCube& cube, std::size_t rank) {
    std::vector<double> coordinates;
    coordinates.reserve(points.size() * rank);
    for (const Vec3& p : points) {
        for (std::size_t axis = 0; axis < rank; ++axis) coordinates.push_back(cube.coordinate(p, axis));
    }
    return coordinates;
}

/// Qt: triangles; Pp: no warnings; QJ: points moved within rounding, where they are flat without.
std::optional<ConvexHull> hull_with(std::span<const Vec3> points, int rank, const char* options) {
    const UnitCube cube(points);
    std::vector<double> coordinates = coordinates_of(points, cube, static_cast<std::size_t>(rank));
    Quickhull quickhull(coordinates, rank, options);
    if (quickhull.failed()) return std::nullopt;
    ConvexHull hull;
    std::unordered_map<std::int32_t, std::int32_t> number;
    quickhull.for_each_facet(static_cast<std::size_t>(rank), [&](const std::array<std::int32_t, 3>& ids, const double* normal) {
        HullFacet facet{.vertex = {}, .normal = cube.normal(normal, static_cast<std::size_t>(rank))};
        for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
            const auto [place, is_new] = number.try_emplace(ids[i], static_cast<std::int32_t>(hull.vertices.size()));
            if (is_new) hull.vertices.push_back(points[static_cast<std::size_t>(ids[i])]);
            facet.vertex[i] = place->second;
        }
        hull.facets.push_back(facet);
    });
    if (hull.facets.empty()) return std::nullopt;
    return hull;
}

bool has_enough(std::span<const Vec3> points, int rank) { return std::ssize(points) > rank; }

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points, int rank) {
    if (has_enough(points, rank)) {
        for (const char* options : {"qhull Qt Pp", "qhull QJ Pp"}) {
            if (std::optional<ConvexHull> hull = hull_with(points, rank, options)) return std::move(*hull);
        }
    }
    return {.vertices = {points.begin(), points.end()}, .facets = {}};
}

std::vector<Vec3> hull_points(std::span<const Vec3> points, int rank) {
    if (has_enough(points, rank)) {
        if (std::optional<ConvexHull> hull = hull_with(points, rank, "qhull Pp Qt")) return std::move(hull->vertices);
    }
    return {points.begin(), points.end()};  // such as the points of a cap at the border of the volume
}

}  // namespace isoatlas
