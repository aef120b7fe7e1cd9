// Pixels that a medium does not show: no ray through them meets matter.
#include "render/footprint.h"

#include <gtest/gtest.h>

#include <random>

#include "isoatlas/render.h"
#include "render/medium.h"
#include "render/scene_box.h"

namespace isoatlas {
namespace {

class Footprints : public testing::Test {
protected:
    std::mt19937_64 random{11};
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

    /// A few boxes of matter in empty space, on a grid with unequal spacing.
    Volume some_volume() {
        Index3 size;
        Geometry geometry;
        for (int a = 0; a < 3; ++a) size[a] = 2 + static_cast<std::int64_t>(between(0, 60)), geometry.spacing[a] = between(0.5, 2);
        Volume volume = make_volume({.rank = 3, .size = size}, ValueType::u8, geometry);
        for (int n = 0; n < 3; ++n) {
            Index3 first, last;
            for (int a = 0; a < 3; ++a) {
                first[a] = static_cast<std::int64_t>(between(0, static_cast<double>(size[a])));
                last[a] = std::min(size[a] - 1, first[a] + static_cast<std::int64_t>(between(0, 12)));
            }
            for (std::int64_t z = first[2]; z <= last[2]; ++z) {
                for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                    for (std::int64_t x = first[0]; x <= last[0]; ++x)
                        volume.samples<std::uint8_t>()[volume.info.extent.index(x, y, z)] = 100;
                }
            }
        }
        return volume;
    }
    Camera some_camera(const SceneBox& box) {
        Camera camera{.projection = between(0, 1) < 0.5 ? Projection::orthographic : Projection::perspective, .target = box.centre()};
        camera.view.toward = unit({between(-1, 1), between(-1, 1), between(-1, 1)});
        for (int a = 0; a < 3; ++a) camera.target[a] += between(-0.5, 0.5) * box.radius();
        camera.height = between(0.3, 3) * box.radius();
        camera.distance = between(0.2, 4) * box.radius();  // also inside of the volume
        return camera;
    }
};

TEST_F(Footprints, RaysThroughOtherPixelsMeetNothing) {
    std::int64_t left_out = 0;
    for (int n = 0; n < 300; ++n) {
        const Volume volume = some_volume();
        Scene scene;
        scene.volume = {.volume = &volume, .tents = {{.low = 20, .high = 200, .colour = {1, 1, 1}, .density = 10, .ramp = 0}}};
        const SceneBox box = box_of(scene);
        const Frame frame{box.centre(), box.radius()};
        const CameraRays camera(some_camera(box), 37, 29);
        const RaySurfaces nothing(scene, RaySurfaces::Which::opaque, frame, {}, 1);
        const Medium medium(scene, frame, nullptr, nothing, 1);
        const Footprint footprint = medium.footprint(camera);
        for (std::int64_t y = 0; y < camera.height(); ++y) {
            for (std::int64_t x = 0; x < camera.width(); ++x) {
                if (footprint.shows(x, y)) continue;
                ++left_out;
                Ray ray = camera.through(static_cast<double>(x) + between(0, 1), static_cast<double>(y) + between(0, 1), 4 * box.radius());
                ray.origin = frame.inside(ray.origin);
                Gathered gathered;
                medium.march(ray, 0, 100, between(0, 1), gathered);
                ASSERT_EQ(gathered.opacity, 0) << "volume " << n << ", pixel " << x << ' ' << y;
            }
        }
    }
    EXPECT_GT(left_out, 10000);  // not nearly all of the 300 pictures
}

}  // namespace
}  // namespace isoatlas
