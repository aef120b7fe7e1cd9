// `simplify=VOXELS`: files of surfaces with fewer triangles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "isoatlas/level_of_detail.h"
#include "server/query_parameters.h"
#include "server/request.h"

namespace isoatlas {

/// What a request says of the files of surfaces that it asks for.
class FewerTriangles {
public:
    explicit FewerTriangles(QueryParameters& words);

    /// Triangles that may be simplified where memory allows so many to be written.
    [[nodiscard]] std::int64_t most_of(std::int64_t triangles) const;
    /// As simplify_surface(); nothing happens if the request says nothing.
    void apply(Surface& surface, const VolumeInfo& info, const Context& context);
    /// The response with its headers: X-Distance: at most so far, in voxels, are the surfaces from the exact ones. X-Triangles: what is
    /// left of all of them.
    [[nodiscard]] Response told(Response response) const;

private:
    std::optional<double> voxels_;
    double distance_ = 0;
    std::int64_t triangles_ = 0;
};

}  // namespace isoatlas
