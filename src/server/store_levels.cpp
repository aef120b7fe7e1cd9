#include "server/store_levels.h"

#include "atlas/access.h"
#include "base/file_system.h"
#include "formats/common/file_access.h"
#include "isoatlas/error.h"
#include "isoatlas/polarity.h"
#include "store/container.h"

namespace isoatlas {
namespace {

/// The surface that is asked for, if levels can be of it.
std::optional<LevelsKey> key_of(const SurfaceOptions& options, double tau) {
    const bool is_whole =
        options.boundary == Boundary::closed && options.style == SurfaceStyle::compact && options.shell == ShellChoice::all;
    if (!is_whole || options.objects.size() + options.contours.size() != 1) return std::nullopt;
    if (options.objects.empty()) return LevelsKey{options.contours[0], tau, true};
    return LevelsKey{options.objects[0], tau, false};
}

/// Servers say in different ways that they do not have a file: some that it is forbidden.
bool is_there(const std::string& path) {
    if (!is_address(path)) return file_exists(path);
    try {
        return file_system().open(path).file != nullptr;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::cancelled) throw;
        return false;
    }
}

}  // namespace

std::optional<SeenSurface> StoreLevels::find(const Atlas& atlas, const SurfaceOptions& options, double tau, const MeshWanted& wanted) {
    constexpr double kWantedPixels = 1;
    const std::optional<LevelsKey> key = key_of(options, tau);
    if (!key) return std::nullopt;
    const Polarity polarity = polarity_of(atlas.info());
    Side& side = sides_[static_cast<std::size_t>(polarity)];
    std::call_once(side.looked, [&] {  // again after an error
        const std::string path = levels_path(AtlasAccess::store(atlas).path(), polarity);
        if (is_there(path)) side.levels.emplace(path, atlas);
    });
    const std::int64_t found = side.levels ? side.levels->find(*key) : -1;
    if (found < 0 || side.levels->surfaces()[static_cast<std::size_t>(found)].triangles <= wanted.triangles) return std::nullopt;
    if (wanted.from) return side.levels->seen_from(found, *wanted.from, kWantedPixels, wanted.triangles);
    return SeenSurface{side.levels->at_most(found, wanted.triangles), 0};
}

}  // namespace isoatlas
