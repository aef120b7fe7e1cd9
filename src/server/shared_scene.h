// The scene that new pages begin with, and that pages in frames share with the program around them: /api/scene, docs/scene.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "isoatlas/server.h"
#include "server/request.h"
#include "server/version_counter.h"

namespace isoatlas {

constexpr std::size_t kLongestScene = std::size_t{4} << 20;  ///< bytes of a scene that is set

/// The scene of a text. path: of its file, for errors. Throws Error{input}: not JSON, not a scene.
[[nodiscard]] SceneFile scene_of(const std::string& path, const std::string& text);

/// From many threads. Every scene that is set has a version, from 1; whoever sets last wins.
class SharedScene {
public:
    /// first: version 0, or none. changes: noted with each one.
    SharedScene(SceneFile first, VersionCounter& changes) : changes_(changes), scene_(std::move(first)) {}

    /// Its text; empty: none.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::uint64_t version() const { return version_; }
    /// The version of the new one. info: of the volume. Throws Error{usage}: too long, not a scene, of a volume of another size.
    std::uint64_t set(const std::string& text, const VolumeInfo& info);

    /// docs/schema/server-scene.
    [[nodiscard]] Response answer(const Request& request) const;
    /// Sets the body of a request; of two clients that change the same version with `after` the second one is refused.
    [[nodiscard]] Response change(const Request& request, const VolumeInfo& info);

private:
    std::uint64_t set(SceneFile scene, const std::string& client);

    VersionCounter& changes_;
    mutable std::mutex mutex_;
    SceneFile scene_;
    std::string client_;  ///< that has set it, without its lane; empty: none, or the program that serves
    std::atomic<std::uint64_t> version_ = 0;
};

}  // namespace isoatlas
