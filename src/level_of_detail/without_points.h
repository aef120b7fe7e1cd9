// What a version of a surface has in common with it.
#pragma once

#include "isoatlas/surface.h"

namespace isoatlas {

/// A surface like this one, without points and triangles: its isovalue, space, interpolant and the rest.
[[nodiscard]] inline Surface without_points(const Surface& like) {
    Surface result;
    result.tau = like.tau, result.reported_tau = like.reported_tau;
    result.space = like.space, result.unit = like.unit;
    result.closed = like.closed, result.interpolant = like.interpolant, result.polarity = like.polarity;
    result.tunnel_height = like.tunnel_height, result.reported_tunnel_height = like.reported_tunnel_height;
    return result;
}

}  // namespace isoatlas
