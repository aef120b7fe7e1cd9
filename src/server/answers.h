// The JSON of the server. Isovalues are in units of the file.
#pragma once

#include <string>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/error.h"
#include "page/contents.h"
#include "server/opening.h"
#include "server/turns.h"

namespace isoatlas::server {

/// What `isoatlas FILE` puts into a page.
[[nodiscard]] std::string atlas_json(const Atlas& atlas, const page::PageContents& contents);
[[nodiscard]] std::string preview_json(const SurfacePreview& preview, double tau);
/// The first `top` objects.
[[nodiscard]] std::string active_json(const ActiveObjects& active, double tau, std::int64_t top);
/// Of the objects of a closed surface with ids. active: those at its isovalue.
[[nodiscard]] std::string measures_json(const Surface& surface, const ActiveObjects& active, double tau);
[[nodiscard]] std::string error_json(const Error& error);
/// On one line. pending: of the client that listens.
[[nodiscard]] std::string events_json(const Opening::State& state, const std::vector<Turns::Pending>& pending);

}  // namespace isoatlas::server
