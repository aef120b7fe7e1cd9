// JSON responses of the server. Isovalues are in units of the file.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "catalogue/page_contents.h"
#include "isoatlas/atlas.h"
#include "isoatlas/collection.h"
#include "isoatlas/error.h"
#include "isoatlas/measures.h"
#include "isoatlas/render.h"
#include "server/job_queues.h"
#include "server/store_state.h"

namespace isoatlas {

/// The data of the page of `isoatlas FILE`.
[[nodiscard]] std::string atlas_json(const StoreSides& sides, const PageContents& contents);
/// An object requested by its highest voxel, and the object that contains this voxel.
struct NamedObject {
    std::optional<std::int64_t> id{};  ///< nullopt: none was requested
    std::optional<ActiveObject> object{};
};
[[nodiscard]] std::string preview_json(const SurfacePreview& preview, double tau, const NamedObject& named);
/// The first `top` objects.
[[nodiscard]] std::string active_json(const ActiveObjects& active, double tau, std::int64_t top);
[[nodiscard]] std::string measures_json(const VolumeInfo& info, std::span<const ObjectMeasures> objects, double tau);

/// A sample, and the objects that contain it.
struct AtVoxel {
    Index3 voxel{};
    Vec3 position{};                      ///< physical
    double value = 0;                     ///< in units of the file
    std::vector<std::int64_t> entries{};  ///< entries of the atlas that contain it, the smallest first
    std::vector<bool> objects{};          ///< per requested object: does it contain the sample?
    std::vector<bool> contours{};
};
[[nodiscard]] std::string at_json(const AtVoxel& at);
/// calibration: for the values of the tents, which are stored ones.
[[nodiscard]] std::string transfer_json(std::span<const OpacityTent> tents, const Calibration& calibration);
[[nodiscard]] std::string address_json(const std::string& address);
/// volume: the number of that which the page shows.
[[nodiscard]] std::string volumes_json(const Channels& channels, std::int64_t volume);
[[nodiscard]] std::string error_json(const Error& error);
/// On one line. pending: jobs of the listening client. scene: the version of the shared one.
[[nodiscard]] std::string events_json(const StoreState::State& state, const std::vector<JobQueues::Pending>& pending, std::uint64_t scene);

}  // namespace isoatlas
