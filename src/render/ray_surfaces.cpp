#include "render/ray_surfaces.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

#include "base/check.h"
#include "base/parallel.h"

namespace isoatlas {
namespace {

#ifdef __SANITIZE_THREAD__
constexpr const char* kDevice = "threads=1";  // the sanitizer does not see the synchronisation of Embree's threads
#else
constexpr const char* kDevice = "";
#endif
constexpr double kTouching = 1e-5;  // of the scene's radius: closer crossings are merged

[[noreturn]] void fail(RTCError code) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) {
        throw Error(ErrorKind::resource, {.what = "not enough memory to prepare the surfaces for ray tracing",
                                          .next = "draw fewer objects, or use a machine with more memory"});
    }
    throw Error(ErrorKind::internal, {.what = "Embree failed with code " + std::to_string(static_cast<int>(code))});
}

RTCRay ray_of(const Ray& ray, double min, double max) {
    RTCRay r{};
    r.org_x = static_cast<float>(ray.origin[0]), r.org_y = static_cast<float>(ray.origin[1]), r.org_z = static_cast<float>(ray.origin[2]);
    r.dir_x = static_cast<float>(ray.direction[0]), r.dir_y = static_cast<float>(ray.direction[1]);
    r.dir_z = static_cast<float>(ray.direction[2]);
    r.tnear = static_cast<float>(min), r.tfar = static_cast<float>(std::min(max, 1e30));
    r.mask = ~0U;
    return r;
}

RTCRayHit ray_hit_of(const Ray& ray, double min, double max) {
    RTCRayHit hit{};
    hit.ray = ray_of(ray, min, max);
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return hit;
}

/// Filter context of one query.
struct Query {
    RTCIntersectContext context{};
    const void* surfaces = nullptr;
    std::vector<Crossing>* crossings = nullptr;
    Gap gap{};
};

float distance(const RTCFilterFunctionNArguments* arguments) { return reinterpret_cast<const RTCRay*>(arguments->ray)->tfar; }

}  // namespace

struct RaySurfaces::Data {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::int64_t> objects;  ///< of every geometry
    const Scene* drawn = nullptr;
    const std::vector<HalfSpace>* removed = nullptr;

    Data() : device(rtcNewDevice(kDevice)) {
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

    void add(std::int64_t object, const Frame& frame, int threads) {
        const Surface& surface = drawn->objects[object].surface;
        const std::size_t points = surface.points.size(), triangles = surface.triangles.size();
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* p =
            static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points));
        auto* t = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
        require();
        for_each_index(threads, points, [&](std::size_t i) {
            const Vec3 inside = frame.inside(surface.points[i]);
            for (int a = 0; a < 3; ++a) p[3 * i + a] = static_cast<float>(inside[a]);
        });
        for_each_index(threads, triangles, [&](std::size_t i) {
            for (int a = 0; a < 3; ++a) t[3 * i + a] = static_cast<std::uint32_t>(surface.triangles[i][a]);
        });
        attach(geometry, object);
    }

    /// Discs instead of triangles.
    void add_points(std::int64_t object, const Frame& frame, int threads) {
        const Surface& surface = drawn->objects[object].surface;
        const std::size_t points = surface.points.size();
        const auto radius = static_cast<float>(drawn->objects[object].point_radius / frame.radius);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
        auto* p =
            static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), points));
        auto* n =
            static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points));
        require();
        for_each_index(threads, points, [&](std::size_t i) {
            const Vec3 inside = frame.inside(surface.points[i]);
            for (int a = 0; a < 3; ++a) p[4 * i + a] = static_cast<float>(inside[a]), n[3 * i + a] = surface.normals[i][a];
            p[4 * i + 3] = radius;
        });
        attach(geometry, object);
    }

    void attach(RTCGeometry geometry, std::int64_t object) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        objects.push_back(object);
        require();
    }

    [[nodiscard]] Crossing crossing(double t, const RTCHit& hit) const {
        const std::int64_t object = objects[hit.geomID];
        const Surface& surface = drawn->objects[object].surface;
        if (surface.triangles.empty()) {
            const auto& n = surface.normals[hit.primID];
            const Vec3 normal{n[0], n[1], n[2]};
            return {t, object, normal, normal};
        }
        // Embree's normal is e1 x e2, and our triangles are counter-clockwise seen from the Low side.
        const Vec3 face = unit({hit.Ng_x, hit.Ng_y, hit.Ng_z});
        if (surface.normals.empty()) return {t, object, face, face};
        const auto& corners = surface.triangles[hit.primID];
        const double weights[3] = {1.0 - hit.u - hit.v, hit.u, hit.v};
        Vec3 normal{};
        for (int c = 0; c < 3; ++c) {
            const auto& n = surface.normals[corners[c]];
            normal = along(normal, weights[c], {n[0], n[1], n[2]});
        }
        return {t, object, norm(normal) > 0 ? unit(normal) : face, face};
    }

    [[nodiscard]] double tau(const Crossing& crossing) const { return drawn->objects[crossing.object].surface.tau; }

    /// Filter: records a crossing and continues.
    static void note(const RTCFilterFunctionNArguments* arguments) {
        if (arguments->valid[0] == 0) return;
        arguments->valid[0] = 0;
        auto* query = reinterpret_cast<Query*>(arguments->context);
        const auto* data = static_cast<const Data*>(query->surfaces);
        query->crossings->push_back(data->crossing(distance(arguments), *reinterpret_cast<const RTCHit*>(arguments->hit)));
    }

    /// Filter: ignores crossings in the clipped part.
    static void pass_gap(const RTCFilterFunctionNArguments* arguments) {
        if (arguments->valid[0] == 0) return;
        const auto* query = reinterpret_cast<const Query*>(arguments->context);
        if (query->gap.holds(distance(arguments))) arguments->valid[0] = 0;
    }
};

RaySurfaces::RaySurfaces(const Scene& scene, Which which, const Frame& frame, const std::vector<HalfSpace>& removed, int threads)
    : data_(std::make_unique<Data>()) {
    data_->drawn = &scene;
    data_->removed = &removed;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        const bool are_discs = object.surface.triangles.empty() && object.point_radius > 0 && !object.surface.points.empty();
        if ((object.opacity >= 1) != (which == Which::opaque) || (object.surface.triangles.empty() && !are_discs)) continue;
        if (object.surface.points.size() >= std::numeric_limits<std::uint32_t>::max()) {
            throw Error(ErrorKind::unsupported,
                        {.what = "a surface of more than 2^32 points", .next = "draw fewer objects, or a part of the volume"});
        }
        are_discs ? data_->add_points(static_cast<std::int64_t>(i), frame, threads)
                  : data_->add(static_cast<std::int64_t>(i), frame, threads);
    }
    with_threads(threads, [&] { rtcCommitScene(data_->scene); });
    data_->require();
}

RaySurfaces::~RaySurfaces() = default;

bool RaySurfaces::empty() const { return data_->objects.empty(); }

std::optional<Crossing> RaySurfaces::first(const Ray& ray) const {
    Query query;
    rtcInitIntersectContext(&query.context);
    RTCRayHit hit = ray_hit_of(ray, 0, INFINITY);
    rtcIntersect1(data_->scene, &query.context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const Crossing found = data_->crossing(hit.ray.tfar, hit.hit);
    if (data_->objects.size() == 1) return found;
    std::vector<Crossing> near;
    query.context.filter = &Data::note;
    query.surfaces = data_.get(), query.crossings = &near;
    RTCRayHit again = ray_hit_of(ray, found.t - kTouching, found.t + kTouching);
    rtcIntersect1(data_->scene, &query.context, &again);
    Crossing best = found;
    for (const Crossing& other : near) {
        if (other.enters(ray) == found.enters(ray) && data_->tau(other) > data_->tau(best)) best = other;
    }
    best.t = found.t;
    return best;
}

void RaySurfaces::all(const Ray& ray, double max, std::vector<Crossing>& crossings) const {
    crossings.clear();
    if (empty()) return;
    Query query;
    rtcInitIntersectContext(&query.context);
    query.context.filter = &Data::note;
    query.surfaces = data_.get(), query.crossings = &crossings;
    RTCRayHit hit = ray_hit_of(ray, 0, max);
    rtcIntersect1(data_->scene, &query.context, &hit);
    std::sort(crossings.begin(), crossings.end(), [&](const Crossing& a, const Crossing& b) {
        if (a.t != b.t) return a.t < b.t;
        if (data_->tau(a) != data_->tau(b)) return data_->tau(a) < data_->tau(b);
        if (a.object != b.object) return a.object < b.object;
        return a.face_normal < b.face_normal;
    });
    // A ray through an edge hits both of its triangles: counted once.
    const auto same = [&](const Crossing& a, const Crossing& b) {
        return a.object == b.object && b.t - a.t < kTouching / 10 && a.enters(ray) == b.enters(ray);
    };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
}

bool RaySurfaces::blocked(const Ray& ray, double min, double max) const {
    if (empty()) return false;
    Query query;
    rtcInitIntersectContext(&query.context);
    query.gap = gap_of(*data_->removed, ray);
    if (!query.gap.empty()) query.context.filter = &Data::pass_gap;
    RTCRay r = ray_of(ray, min, max);
    rtcOccluded1(data_->scene, &query.context, &r);
    return r.tfar < 0;
}

Gap gap_of(const std::vector<HalfSpace>& removed, const Ray& ray) {
    if (removed.empty()) return {};
    Gap gap{-INFINITY, INFINITY};
    for (const HalfSpace& half : removed) {
        const double speed = dot(half.normal, ray.direction), ahead = half.offset - dot(half.normal, ray.origin);
        if (speed == 0) {
            if (ahead >= 0) return {};
        } else if (speed > 0) {
            gap.begin = std::max(gap.begin, ahead / speed);
        } else {
            gap.end = std::min(gap.end, ahead / speed);
        }
    }
    return gap;
}

}  // namespace isoatlas
