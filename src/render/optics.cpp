#include "render/optics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "render/samples.h"

namespace isoatlas {
namespace {

constexpr double kHidden = 0.9995;  // opacity behind which nothing is seen: what is scattered may be brighter than white
constexpr double kDark = 12;        // optical depth through which no light comes
constexpr double kFaint = 0.05;     // paths that carry less than this part of what they began with are ended, or made brighter, by chance

double largest(const Vec3& a) { return std::max({a[0], a[1], a[2]}); }

double depth_of(const MatterSegment& segment) { return segment.matter.extinction * (segment.end - segment.begin); }
Vec3 colour_of(const OpticalProperties& matter) { return scale(matter.glow, 1 / matter.extinction); }

/// Number i of a path.
double number(std::uint32_t seed, int i) { return fraction_of(hash(seed, static_cast<std::uint32_t>(i))); }

/// t within a segment before which matter takes the part `share` of what the whole segment takes.
double place_of(const MatterSegment& segment, double share) {
    const double taken = -std::expm1(-depth_of(segment));
    return std::min(segment.end, segment.begin - std::log1p(-share * taken) / segment.matter.extinction);
}

/// A direction after scattering.
Vec3 turned(const Vec3& direction, double asymmetry, double u, double v) {
    Vec3 a, b;
    basis_of(direction, a, b);
    const double cosine = phase_cosine(asymmetry, u), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)),
                 angle = 2 * std::numbers::pi * v;
    return unit(along(along(scale(direction, cosine), sine * std::cos(angle), a), sine * std::sin(angle), b));
}

}  // namespace

double phase_of(double asymmetry, double cosine) {
    const double g = asymmetry, root = std::sqrt(1 + g * g - 2 * g * cosine);
    return (1 - g * g) / (root * root * root);
}

double phase_cosine(double asymmetry, double u) {
    if (std::abs(asymmetry) < 1e-4) return 1 - 2 * u;
    const double g = asymmetry, part = (1 - g * g) / (1 - g + 2 * g * u);
    return std::clamp((1 + g * g - part * part) / (2 * g), -1.0, 1.0);
}

Optics::Optics(const SceneVolume& volume, const Medium& medium, const Vec3& to_key, const RaySurfaces& solid,
               const std::vector<HalfSpace>& removed)
    : model_(volume.optics),
      scattering_(volume.scattering),
      medium_(medium),
      solid_(solid),
      removed_(removed),
      to_light_(norm(volume.scattering.to_light) > 0 ? unit(volume.scattering.to_light) : to_key) {}

void Optics::march(const Ray& ray, double begin, double end, const RayNumbers& numbers, Gathered& gathered) const {
    switch (model_) {
        case OpticalModel::absorption: return absorb(ray, begin, end, numbers.shift, gathered);
        case OpticalModel::emission: return emit(ray, begin, end, numbers.shift, gathered);
        default: break;
    }
    const Event event = scatter_once(ray, begin, end, numbers, gathered);
    if (model_ != OpticalModel::multiple_scattering || !(event.weight > 0)) return;
    const std::uint32_t seed = hash(numbers.seed, std::bit_cast<std::uint32_t>(static_cast<float>(begin)));
    gathered.light = along(gathered.light, event.weight, scatter_on(event, ray.direction, seed));
}

/// The medium outside of what is cut away.
void Optics::visit(const Ray& ray, double begin, double end, double shift, const Visit& visit) const {
    const Gap gap = gap_of(removed_, ray);
    if (gap.empty()) return medium_.visit_matter(ray, begin, end, shift, visit);
    bool goes_on = true;
    const auto watched = [&](const MatterSegment& segment) { return goes_on = visit(segment); };
    medium_.visit_matter(ray, begin, std::min(end, gap.begin), shift, std::cref(watched));
    if (goes_on) medium_.visit_matter(ray, std::max(begin, gap.end), end, shift, visit);
}

void Optics::absorb(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const {
    const auto take = [&](const MatterSegment& segment) {
        gathered.opacity += (1 - gathered.opacity) * -std::expm1(-depth_of(segment));
        return gathered.opacity < kHidden;
    };
    visit(ray, begin, end, shift, std::cref(take));
}

void Optics::emit(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const {
    const auto take = [&](const MatterSegment& segment) {
        gathered.light = along(gathered.light, (1 - gathered.opacity) * (segment.end - segment.begin), segment.matter.glow);
        return true;
    };
    visit(ray, begin, end, shift, std::cref(take));
}

double Optics::lamplight(const Vec3& point, const Vec3& direction) const {
    if (scattering_.light == 0) return 0;
    const Ray ray{point, to_light_};
    if (solid_.blocked(ray, 2 * medium_.step(), INFINITY)) return 0;
    double depth = 0;
    const auto take = [&](const MatterSegment& segment) {
        depth += depth_of(segment);
        return depth < kDark;
    };
    visit(ray, 0, INFINITY, 0, std::cref(take));
    // Light travels away from the lamp and, along a ray from the eye, against its direction.
    return depth < kDark ? scattering_.light * phase_of(scattering_.asymmetry, dot(to_light_, direction)) * std::exp(-depth) : 0;
}

/// Adds the light of the lamp that is scattered once towards the eye. Returns one event, drawn by how much light is taken where.
Optics::Event Optics::scatter_once(const Ray& ray, double begin, double end, const RayNumbers& numbers, Gathered& gathered) const {
    Event drawn;
    int i = 0;
    const auto take = [&](const MatterSegment& segment) {
        const double weight = (1 - gathered.opacity) * -std::expm1(-depth_of(segment));
        const Vec3 colour = scale(colour_of(segment.matter), scattering_.albedo);
        // Half of what the segment takes is taken before this place: exact where light comes along the ray, or from aside.
        const double light = lamplight(along(ray.origin, place_of(segment, 0.5), ray.direction), ray.direction);
        gathered.light = along(gathered.light, weight * light, colour);
        gathered.opacity += weight, drawn.weight += weight;
        if (model_ == OpticalModel::multiple_scattering && number(numbers.seed, ++i) * drawn.weight < weight) {
            drawn.point = along(ray.origin, place_of(segment, number(~numbers.seed, i)), ray.direction);
            drawn.colour = colour;
        }
        return gathered.opacity < kHidden;
    };
    visit(ray, begin, end, numbers.shift, std::cref(take));
    return drawn;
}

/// Light in a straight line up to the next event.
struct Optics::Flight {
    std::optional<double> length;  ///< none: it leaves the medium
    Vec3 colour{};
};

/// The depth at which an event happens is exponential; segments are passed until it is reached.
Optics::Flight Optics::fly(const Ray& ray, double u, double shift) const {
    Flight flight;
    double left = -std::log1p(-u);
    const auto take = [&](const MatterSegment& segment) {
        const double depth = depth_of(segment);
        if (depth < left) {
            left -= depth;
            return true;
        }
        flight.length = segment.begin + left / segment.matter.extinction, flight.colour = colour_of(segment.matter);
        return false;
    };
    visit(ray, 0, INFINITY, shift, std::cref(take));
    return flight;
}

/// Light that is scattered at the first event after others: of the lamp from the second event on, of the sky from the first. The path goes
/// from the eye to the light, which phase functions do not notice.
Vec3 Optics::scatter_on(const Event& first, const Vec3& direction, std::uint32_t seed) const {
    Vec3 light{}, carried = first.colour;
    const double faint = kFaint * largest(carried);
    Ray ray{first.point, direction};
    for (int event = 1; event < scattering_.max_events && largest(carried) > 0; ++event) {
        auto next = [&, i = 8 * event]() mutable { return number(seed, i++); };
        if (largest(carried) < faint) {
            if (next() * faint >= largest(carried)) break;
            carried = scale(carried, faint / largest(carried));
        }
        const double u = next(), v = next();
        ray.direction = turned(ray.direction, scattering_.asymmetry, u, v);
        const double depth = next(), shift = next();
        const Flight flight = fly(ray, depth, shift);
        if (solid_.blocked(ray, 2 * medium_.step(), flight.length.value_or(INFINITY))) break;
        if (!flight.length) return along(light, scattering_.sky, carried);
        ray.origin = along(ray.origin, *flight.length, ray.direction);
        carried = times(carried, scale(flight.colour, scattering_.albedo));
        light = along(light, lamplight(ray.origin, ray.direction), carried);
    }
    return light;
}

}  // namespace isoatlas
