// The part of a store that contains one object whole.
#pragma once

#include <cstdint>
#include <optional>

namespace isoatlas {

class StoredSamples;
struct Context;
struct LevelQuery;
struct StoredWindow;

/// Grows a box of bricks around a High voxel until the voxel's object at tau lies inside, three samples away from every end that is not an
/// end of the volume: then its contours and their normals are those of the volume. nullopt when the box would be most of the volume, or in
/// 2D: then the whole is cheaper. Cost: proportional to the last box.
[[nodiscard]] std::optional<StoredWindow> window_of_object(StoredSamples& samples, std::int64_t voxel, double tau, double tunnel_height,
                                                           const Context& context, LevelQuery& query);

}  // namespace isoatlas
