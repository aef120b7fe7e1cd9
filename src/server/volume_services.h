// The services of a server: one for each volume, made when it is asked for.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "isoatlas/error.h"
#include "isoatlas/server.h"
#include "server/service.h"

namespace isoatlas {

/// Thread safe.
class VolumeServices {
public:
    VolumeServices(const std::string& token, const ServerOptions& options, const Context& context);

    /// A service, which is not closed before the last copy is gone.
    using Use = std::shared_ptr<Service>;
    [[nodiscard]] bool has(std::optional<std::int64_t> volume) const;
    [[nodiscard]] Error no_such_volume(std::optional<std::int64_t> volume) const;
    /// nullopt: the first. Calls ServerOptions::wanted for any other one that is new, or whose page is requested.
    /// Throws Error{not_found}: no such volume.
    [[nodiscard]] Use use(std::optional<std::int64_t> volume, bool is_page = false);
    [[nodiscard]] Use first() { return use({}); }
    /// false: somebody uses it.
    [[nodiscard]] bool close(std::int64_t volume);
    /// Cancels all running requests; there are no new services from now on.
    void end();

    [[nodiscard]] const Channels& channels() const { return channels_; }
    [[nodiscard]] std::int64_t number_of(std::optional<std::int64_t> volume) const { return volume.value_or(first_); }

private:
    const std::string token_;
    const Channels channels_;
    const std::int64_t first_;
    const std::function<void(std::int64_t)> wanted_;
    const Context context_;
    const ServiceOptions options_;  ///< without a scene
    std::mutex mutex_;
    bool is_ended_ = false;
    std::map<std::int64_t, std::shared_ptr<Service>> services_;
};

}  // namespace isoatlas
