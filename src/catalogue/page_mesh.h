// Coarse surfaces inside a page, so that a page that was mailed can be turned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// At most so many triangles of an object are kept until the page knows how many bytes each may have.
inline constexpr std::size_t kMaxPageTriangles = 30'000;
/// Of a page with meshes. Pages whose pictures alone are larger have no meshes.
inline constexpr std::int64_t kMaxPageBytes = 5'000'000;

struct PageMesh {
    std::string data;  ///< preview/wire_mesh.h in base64; empty: there is none
    std::int64_t triangles = 0;
    std::int64_t of = 0;          ///< triangles of the surface that it stands for
    bool keeps_topology = false;  ///< the same components and tunnels as that surface
};

/// A surface with few triangles, and how many it had.
struct CoarseSurface {
    Surface surface;
    std::int64_t of = 0;
    bool keeps_topology = false;
};

/// At most kMaxPageTriangles triangles: by collapses that keep the topology, where it allows so few.
[[nodiscard]] CoarseSurface coarse_for_page(const Surface& surface, const Context& context);
/// In at most max_bytes of text; none where that is too little for a recognisable shape.
[[nodiscard]] PageMesh page_mesh(const CoarseSurface& coarse, std::int64_t max_bytes, const Context& context);
/// As many triangles each as fit in max_bytes together: what one leaves, the others share.
[[nodiscard]] std::vector<PageMesh> page_meshes(std::span<const CoarseSurface> surfaces, std::int64_t max_bytes, const Context& context);

}  // namespace isoatlas
