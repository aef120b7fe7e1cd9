// The part of a store that contains one object whole.
#pragma once

#include <cstdint>

namespace isoatlas {

class StoredSamples;
struct Context;
struct LevelQuery;
struct ObjectPart;

/// Grows a box of bricks around a High voxel until the voxel's object at tau lies inside, three samples away from every end that is not an
/// end of the volume: then its contours and their normals are those of the volume. No window when the box would be most of the volume, or
/// in 2D: then the whole is cheaper. is_alone: other objects, and the ids of regions around this one, do not matter: an object that a small
/// box does not contain is then followed from brick to brick. Cost: proportional to the last box.
[[nodiscard]] ObjectPart part_of_object(StoredSamples& samples, std::int64_t voxel, double tau, double tunnel_height, bool is_alone,
                                        const Context& context, LevelQuery& query);

}  // namespace isoatlas
