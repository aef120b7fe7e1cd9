#include "server/object_points.h"

#include "isoatlas/atlas.h"
#include "isoatlas/error.h"
#include "isoatlas/surface_points.h"

namespace isoatlas {

Surface points_as_squares(const Atlas& atlas, const Surface& surface, const PointLimits& limits, const Context& context) {
    const SampleBox box = samples_around(atlas.info(), surface);
    const std::int64_t bytes = box.size().product() * static_cast<std::int64_t>(size_of(atlas.info().type));
    const std::int64_t triangles = std::ssize(surface.triangles) * limits.divisions * limits.divisions;  // about
    if (triangles > limits.triangles || bytes > limits.bytes)
        throw Error(ErrorKind::resource, {.what = "the points exceed the memory budget of this server",
                                          .next = "request one object, or the surface as triangles"});
    const Volume samples = atlas.samples(box, 1, context);
    const PointCloud cloud = points_of_surface(samples, surface, limits.divisions, context);
    return as_squares(cloud, disc_radius(atlas.info(), limits.divisions));
}

}  // namespace isoatlas
