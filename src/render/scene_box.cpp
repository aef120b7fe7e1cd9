#include "render/scene_box.h"

namespace isoatlas::render {

SceneBox box_of(const Scene& scene) {
    SceneBox box;
    for_each_outline_point(scene, [&](const Vec3& point) { box.take(point); });
    if (box.empty()) {
        throw Error(ErrorKind::not_found, {.what = "there is nothing to draw: no object has a surface here",
                                           .next = "choose an isovalue between the lowest and the highest sample"});
    }
    return box;
}

}  // namespace isoatlas::render
