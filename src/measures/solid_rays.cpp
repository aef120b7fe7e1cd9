#include "measures/solid_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/parallel.h"
#include "isoatlas/error.h"
#include "measures/vectors.h"

namespace isoatlas {
namespace {

#ifdef __SANITIZE_THREAD__
constexpr const char* kDevice = "threads=1";  // the sanitizer does not see the synchronisation of Embree's threads
#else
constexpr const char* kDevice = "";
#endif

[[noreturn]] void fail(RTCError code) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) throw Error(ErrorKind::resource, {.what = "not enough memory for rays through the surface"});
    throw Error(ErrorKind::internal, {.what = "Embree failed with code " + std::to_string(static_cast<int>(code))});
}

/// The middle of the box around points, and half of its diagonal.
struct Ball {
    Vec3 centre{};
    double radius = 1;

    explicit Ball(const Surface& surface) {
        if (surface.points.empty()) return;
        Vec3 low = surface.points[0], high = low;
        for (const Vec3& p : surface.points) {
            for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
        }
        centre = plus(low, times(0.5, minus(high, low)));
        radius = std::max(norm(minus(high, low)) / 2, 1e-300);
    }
    /// In the unit ball, where floats are accurate enough.
    [[nodiscard]] Vec3 inside(const Vec3& p) const { return times(1 / radius, minus(p, centre)); }
};

/// Filter context of one ray.
struct Query {
    RTCIntersectContext context{};
    const Surface* surface = nullptr;
    std::int64_t point = 0;
};

/// Filter: only triangles that the ray leaves through, and none of the point it begins at.
void leave(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const auto* query = reinterpret_cast<const Query*>(arguments->context);
    const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    const bool leaves = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z > 0;
    const std::array<std::int64_t, 3>& corners = query->surface->triangles[hit->primID];
    if (!leaves || std::ranges::find(corners, query->point) != corners.end()) arguments->valid[0] = 0;
}

}  // namespace

struct SolidRays::Data {
    const Surface& surface;
    Ball ball;
    RTCDevice device;
    RTCScene scene = nullptr;

    explicit Data(const Surface& of) : surface(of), ball(of), device(rtcNewDevice(kDevice)) {
        if (device == nullptr) fail(rtcGetDeviceError(nullptr));
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    }
    ~Data() {
        if (scene != nullptr) rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;

    void require() const {
        if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE) fail(code);
    }

    void fill(int threads) {
        const std::size_t points = surface.points.size(), triangles = surface.triangles.size();
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* p =
            static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points));
        auto* t = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
        require();
        for_each_index(threads, points, [&](std::size_t i) {
            const Vec3 inside = ball.inside(surface.points[i]);
            for (std::size_t k = 0; k < 3; ++k) p[3 * i + k] = static_cast<float>(inside[k]);
        });
        for_each_index(threads, triangles, [&](std::size_t i) {
            for (std::size_t k = 0; k < 3; ++k) t[3 * i + k] = static_cast<std::uint32_t>(surface.triangles[i][k]);
        });
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        require();
    }
};

SolidRays::SolidRays(const Surface& surface, const Context& context) : data_(std::make_unique<Data>(surface)) {
    data_->fill(context.threads);
    with_threads(context.threads, [&] { rtcCommitScene(data_->scene); });
    data_->require();
}

SolidRays::~SolidRays() = default;

std::optional<SolidRays::Exit> SolidRays::way_out(std::size_t point, const Vec3& direction) const {
    Query query;
    rtcInitIntersectContext(&query.context);
    query.context.filter = leave;
    query.surface = &data_->surface, query.point = static_cast<std::int64_t>(point);
    const Vec3 origin = data_->ball.inside(data_->surface.points[point]);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(origin[0]), ray.ray.org_y = static_cast<float>(origin[1]);
    ray.ray.org_z = static_cast<float>(origin[2]);
    ray.ray.dir_x = static_cast<float>(direction[0]), ray.ray.dir_y = static_cast<float>(direction[1]);
    ray.ray.dir_z = static_cast<float>(direction[2]);
    ray.ray.tfar = 1e30F, ray.ray.mask = ~0U;
    ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(data_->scene, &query.context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const Vec3 normal{ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z};
    return Exit{ray.ray.tfar * data_->ball.radius, dot(normal, direction) / norm(normal)};
}

}  // namespace isoatlas
