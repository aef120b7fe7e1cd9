// The JSON of the server. Isovalues are in units of the file.
#pragma once

#include <string>

#include "isoatlas/atlas.h"
#include "isoatlas/error.h"

namespace isoatlas::server {

/// What `isoatlas FILE` puts into a page, without pictures. Cost: reads the trees and some samples.
[[nodiscard]] std::string atlas_json(const Atlas& atlas, const Context& context);
[[nodiscard]] std::string preview_json(const SurfacePreview& preview, double tau);
/// The first `top` objects.
[[nodiscard]] std::string active_json(const ActiveObjects& active, double tau, std::int64_t top);
[[nodiscard]] std::string error_json(const Error& error);

}  // namespace isoatlas::server
