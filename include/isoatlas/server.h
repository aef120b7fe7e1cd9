// Server: a store behind a local address, for the viewer in a browser and for programs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/collection.h"
#include "isoatlas/context.h"
#include "isoatlas/error.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// What lets a link to a page of a store open again when another server of the store runs.
struct ServerLink {
    int port = 0;          ///< where ServerOptions::port is 0: listens on this one, or if it is taken on any that is free; 0: none
    std::string token{};   ///< where ServerOptions::token is empty
    std::string cookie{};  ///< of browsers, with the key; empty: new ones
    std::string key{};     ///< of pages
    bool is_kept = false;  ///< another server of the store will have the same: browsers keep the cookie for 30 days
    std::string note{};    ///< a sentence, where earlier links do not open, or those of now will not; else empty
};

/// The port from 49152 on that follows from the path of the store, and secrets that are kept in a file of this user alone: link-HASH in
/// $XDG_STATE_HOME/isoatlas, else ~/.local/state/isoatlas. The file is made where it is missing, or is malformed, a symbolic link, or open
/// to other users. The store need not be there. is_new: the secrets are replaced, earlier links do not open any more.
[[nodiscard]] ServerLink link_of_store(const std::string& store, bool is_new = false);

/// Throws Error{unsupported} when this isoatlas was built without its pages: a server then answers programs alone.
void check_has_viewer();

/// A scene that the viewer has saved: docs/scene.md.
struct SceneFile {
    std::string path{}, text{};
    std::string volume{};              ///< its name
    std::vector<std::int64_t> size{};  ///< samples along its axes
};

/// Throws Error{input}: there is no such file, it is not JSON, or not a scene.
[[nodiscard]] SceneFile read_scene(const std::string& path);
/// Throws Error{usage}: the scene is of a volume of another size. The page finds out whether it has the same objects.
void check_scene(const SceneFile& scene, const VolumeInfo& info);

struct ServerOptions {
    int port = 0;               ///< 1 to 65535; 0: that of the link, or any that is free
    std::string token{};        ///< what requests of programs must carry, 16 to 256 letters and digits; empty: 128 random bits
    std::int64_t memory = 0;    ///< bytes for responses in progress at a time; 0: a quarter of the memory available
    bool is_read_only = false;  ///< names of objects cannot be changed
    ServerLink link{};
    SceneFile scene{};  ///< a page without a link to a view begins with it; none where its text is empty. See also Server::set_scene()

    // Of a file of several channels or time steps, which pages have menus of: volume N is at /volume/N/.
    Channels channels{};
    std::int64_t first = 0;  ///< the volume of addresses without a number
    /// Told of each page of another volume, and of a request that finds it closed, from any thread: whoever runs the server opens it. Must
    /// return at once.
    std::function<void(std::int64_t volume)> wanted{};
};

/// Listens on 127.0.0.1 alone. Requests and responses: docs/server.md. Writes nothing to any disk but what keep_token() does, and names
/// that authorised clients give to objects, beside the store (isoatlas/object_names.h).
class Server {
public:
    /// There is no store yet: see open(). Throws Error: resource (the port is taken), usage (no such token can be used).
    explicit Server(const ServerOptions& options = {}, const Context& context = {});
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    ~Server();

    [[nodiscard]] int port() const;
    /// For programs, which send the token with it: http://127.0.0.1:PORT
    [[nodiscard]] std::string address() const;
    [[nodiscard]] const std::string& token() const;
    /// A new address that opens the page in one browser: valid once, for ten minutes; the oldest of more than 16 expires. Thread safe.
    [[nodiscard]] std::string address_for_one_use();
    /// The same of a page for a frame of any other page, such as a cell of a notebook: it needs no cookie and may be below another name, of
    /// a proxy. Pages in frames share a scene with this program. Thread safe.
    [[nodiscard]] std::string address_for_one_frame();
    /// Keeps the token in a file of this user alone, where ask_server() finds it, as long as this lives: viewer-PORT in
    /// $XDG_RUNTIME_DIR/isoatlas, else $XDG_CACHE_HOME/isoatlas or ~/.cache/isoatlas. Throws Error{resource}.
    void keep_token();
    /// Serves requests until stop() is called.
    void run();
    /// Thread safe; requests in progress are cancelled.
    void stop();

    // Thread safe; shown by all open pages of the volume: a number below ServerOptions::channels.count(); nullopt: the first one.
    using VolumeNumber = std::optional<std::int64_t>;
    /// From now on requests are served from this store, which must live as long as this, or until close(). low: the same store, open for
    /// objects of low values, where both polarities are served.
    void open(const Atlas& atlas, const Atlas* low = nullptr, VolumeNumber volume = {});
    /// No more requests are served from its store, which may end; false: there are pages of it, or requests. Of no other than the first.
    [[nodiscard]] bool close(std::int64_t volume);
    /// Computes what every page requests first, from the store that is open, in advance; returns when it is done, has failed, or stop() was
    /// called. Requests meanwhile wait for the same result. Cost: the trees are read.
    void prepare(const Context& context = {}, VolumeNumber volume = {});
    /// The store is being built.
    void report_progress(const BuildState& state, VolumeNumber volume = {});
    /// There will be no store. Another report_progress() or open() revokes it.
    void fail(const Error& error, VolumeNumber volume = {});
    /// The scene that pages in frames show, JSON (docs/scene.md): that which was set last, by one of them or set_scene(); else that of the
    /// options; empty: none. New pages begin with it.
    [[nodiscard]] std::string scene() const;
    /// Pages in frames show it at once. Throws Error: usage (not a scene, of a volume of another size, longer than 4 MiB), resource (there
    /// is no store yet).
    void set_scene(const std::string& text);

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
