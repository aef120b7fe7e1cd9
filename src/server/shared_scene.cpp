#include "server/shared_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

#include "isoatlas/error.h"
#include "server/document.h"
#include "server/query_parameters.h"

namespace isoatlas {
namespace {

constexpr std::size_t kLongestClient = 100;

Response json_response(std::string text) { return {200, "application/json", std::move(text)}; }

/// Errors of a scene that comes with a request, or from a program, are those of its sender.
SceneFile checked(const std::string& text, const VolumeInfo& info) {
    if (text.size() > kLongestScene)
        throw Error(ErrorKind::usage, {.where = "the scene", .what = "too long", .expected = std::to_string(kLongestScene) + " bytes"});
    try {
        SceneFile scene = scene_of({}, text);
        check_scene(scene, info);
        return scene;
    } catch (const Error& error) {
        const ErrorText& what = error.text();
        throw Error(ErrorKind::usage, {.where = what.where.empty() ? "the scene" : "the scene, " + what.where,
                                       .what = what.what,
                                       .expected = what.expected,
                                       .next = "docs/scene.md describes scenes"});
    }
}

}  // namespace

std::string SharedScene::text() const {
    const std::lock_guard lock(mutex_);
    return scene_.text;
}

std::uint64_t SharedScene::set(SceneFile scene, const std::string& client) {
    scene_ = std::move(scene);
    client_ = client.substr(0, std::min(client.find('/'), kLongestClient));
    return ++version_;
}

std::uint64_t SharedScene::set(const std::string& text, const VolumeInfo& info) {
    SceneFile scene = checked(text, info);
    std::uint64_t version = 0;
    {
        const std::lock_guard lock(mutex_);
        version = set(std::move(scene), {});
    }
    changes_.note();
    return version;
}

Response SharedScene::answer(const Request& request) const {
    QueryParameters(request.words).reject_unknown();
    const std::lock_guard lock(mutex_);
    const std::string name = std::filesystem::path(scene_.path).filename().string();
    std::string text = document("scene", [&](JsonStream& json) {
        json.key("version").value(static_cast<std::int64_t>(version_)).key("client").value(client_).key("file").value(name);
    });
    text.erase(text.rfind('}'));  // its text is JSON already
    return json_response(text + ", \"scene\": " + (scene_.text.empty() ? "null" : scene_.text) + "}\n");
}

Response SharedScene::change(const Request& request, const VolumeInfo& info) {
    QueryParameters words(request.words);
    const std::optional<std::int64_t> after = words.whole("after", 0, std::numeric_limits<std::int64_t>::max());
    words.reject_unknown();
    SceneFile scene = checked(request.body, info);
    std::uint64_t version = 0;
    {
        const std::lock_guard lock(mutex_);
        if (after && static_cast<std::uint64_t>(*after) != version_)
            throw Error(ErrorKind::cancelled, {.where = "after",
                                               .what = "the scene has been changed since",
                                               .expected = "version " + std::to_string(version_),
                                               .next = "request /api/scene, then set it again"});
        version = set(std::move(scene), request.client);
    }
    changes_.note();
    return json_response(
        document("scene-version", [&](JsonStream& json) { json.key("version").value(static_cast<std::int64_t>(version)); }));
}

}  // namespace isoatlas
