// What the mesh theorems share: random volumes of every sample type and geometry, and simple readings of a surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "isoatlas/surface.h"
#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {

/// A type that holds all samples of the grid exactly.
inline isoatlas::ValueType arbitrary_type(const Grid& grid) {
    using isoatlas::ValueType;
    std::vector<ValueType> types{ValueType::f64};
    const auto all = [&](auto&& holds) { return std::all_of(grid.value.begin(), grid.value.end(), holds); };
    if (all([](double v) { return static_cast<double>(static_cast<float>(v)) == v; })) types.push_back(ValueType::f32);
    if (all([](double v) { return v == std::floor(v) && v >= -128 && v <= 127; })) {
        for (const ValueType type : {ValueType::i8, ValueType::i16, ValueType::i32}) types.push_back(type);
        if (all([](double v) { return v >= 0; })) {
            for (const ValueType type : {ValueType::u8, ValueType::u16, ValueType::u32}) types.push_back(type);
        }
    }
    return types[*rc::gen::inRange<std::size_t>(0, types.size())];
}

/// One of the interesting isovalues.
inline double arbitrary_tau(const Elements& elements) {
    const std::vector<double> values = interesting_values(elements);
    return values[*rc::gen::inRange<std::size_t>(0, values.size())];
}

/// Anisotropic, moved, mirrored, sheared or rectilinear.
inline isoatlas::Geometry arbitrary_geometry(const Grid& grid) {
    isoatlas::Geometry geometry;
    geometry.spacing = {0.5, 1, 3};
    geometry.origin = {-7, 11, 100};
    const int kind = *rc::gen::inRange(0, 4);
    if (kind == 1) geometry.direction = {{{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}}};  // determinant +1
    if (kind == 2) geometry.direction = {{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};    // mirrored
    if (kind == 3) {
        geometry.direction = {{{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}}};
        for (int axis = 0; axis < grid.rank; ++axis) {
            double at = 3;
            for (Index i = 0; i < grid.size[axis]; ++i) geometry.coordinates[axis].push_back(at += 0.25 + static_cast<double>(i * i % 5));
        }
    }
    return geometry;
}

inline isoatlas::Context arbitrary_context() {
    isoatlas::Context context;
    context.threads = *rc::gen::inRange(1, 4);
    context.slab_slices = *rc::gen::element(0, 1, 2, 5);
    return context;
}

struct Vector {
    double x, y, z;
};
inline Vector between(const isoatlas::Vec3& p, const isoatlas::Vec3& q) { return {q[0] - p[0], q[1] - p[1], q[2] - p[2]}; }
inline double triple(const Vector& a, const Vector& b, const Vector& c) {
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

/// Six times the signed volume inside the triangles of each contour, seen from one of its points.
inline std::map<Index, double> signed_volumes(const isoatlas::Surface& surface) {
    std::map<Index, double> volume;
    std::map<Index, Index> origin;
    for (const auto& t : surface.triangles) {
        const Index contour = surface.contour[t[0]];
        const isoatlas::Vec3& o = surface.points[origin.emplace(contour, t[0]).first->second];
        volume[contour] += triple(between(o, surface.points[t[0]]), between(o, surface.points[t[1]]), between(o, surface.points[t[2]]));
    }
    return volume;
}

/// Does the segment p q cross the inside of a triangle? Touching does not count.
inline bool crosses(const isoatlas::Vec3& p, const isoatlas::Vec3& q, const isoatlas::Vec3& a, const isoatlas::Vec3& b,
                    const isoatlas::Vec3& c) {
    const double tiny = 1e-13;
    const double from = triple(between(a, b), between(a, c), between(a, p)), to = triple(between(a, b), between(a, c), between(a, q));
    if (!((from > tiny && to < -tiny) || (from < -tiny && to > tiny))) return false;
    const double u = triple(between(p, q), between(p, a), between(p, b)), v = triple(between(p, q), between(p, b), between(p, c)),
                 w = triple(between(p, q), between(p, c), between(p, a));
    return (u > tiny && v > tiny && w > tiny) || (u < -tiny && v < -tiny && w < -tiny);
}

/// Number of pairs (edge of one triangle, other triangle) that cross without a common point of the mesh.
inline Index count_crossings(const isoatlas::Surface& surface) {
    Index crossings = 0;
    for (const auto& t : surface.triangles) {
        for (const auto& s : surface.triangles) {
            for (int i = 0; i < 3; ++i) {
                const Index p = t[i], q = t[(i + 1) % 3];
                if (std::find(s.begin(), s.end(), p) != s.end() || std::find(s.begin(), s.end(), q) != s.end()) continue;
                crossings +=
                    crosses(surface.points[p], surface.points[q], surface.points[s[0]], surface.points[s[1]], surface.points[s[2]]);
            }
        }
    }
    return crossings;
}

}  // namespace oracle
