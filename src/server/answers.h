// The JSON of the server. Isovalues are in units of the file.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "catalogue/page_contents.h"
#include "isoatlas/atlas.h"
#include "isoatlas/error.h"
#include "isoatlas/render.h"
#include "server/job_queues.h"
#include "server/store_state.h"

namespace isoatlas {

/// What `isoatlas FILE` puts into a page.
[[nodiscard]] std::string atlas_json(const Atlas& atlas, const PageContents& contents);
/// An object that was asked for by its highest voxel, and what is there under this name.
struct NamedObject {
    std::optional<std::int64_t> id{};  ///< nothing: none was asked for
    std::optional<ActiveObject> object{};
};
[[nodiscard]] std::string preview_json(const SurfacePreview& preview, double tau, const NamedObject& named);
/// The first `top` objects.
[[nodiscard]] std::string active_json(const ActiveObjects& active, double tau, std::int64_t top);
/// Of the objects of a closed surface with ids. active: those at its isovalue.
[[nodiscard]] std::string measures_json(const Surface& surface, const ActiveObjects& active, double tau);

/// A sample, and what holds it.
struct AtVoxel {
    std::array<std::int64_t, 3> voxel{};
    Vec3 position{};                      ///< physical
    double value = 0;                     ///< in units of the file
    std::vector<std::int64_t> entries{};  ///< of the atlas that hold it, the smallest first
    std::vector<bool> objects{};          ///< of those asked for: does it hold the sample?
    std::vector<bool> contours{};
};
[[nodiscard]] std::string at_json(const AtVoxel& at);
/// calibration: of the values of the bumps, which are stored ones.
[[nodiscard]] std::string transfer_json(std::span<const OpacityTent> bumps, const Calibration& calibration);
[[nodiscard]] std::string address_json(const std::string& address);
[[nodiscard]] std::string error_json(const Error& error);
/// On one line. pending: of the client that listens.
[[nodiscard]] std::string events_json(const StoreState::State& state, const std::vector<JobQueues::Pending>& pending);

}  // namespace isoatlas
