// The volumes of a viewer: each is a store, which is opened, or built first.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "data/several.h"

namespace isoatlas::cli {

class Terminal;

/// Of one volume.
struct Viewed {
    Arguments arguments;
    std::string store;                ///< path
    std::optional<Atlas> atlas, low;  ///< low: of a store of both polarities that is shown with both

    /// Of arguments whose inputs are assumed. Throws Error{usage}: labels.
    explicit Viewed(Arguments own);
    void open();
    void show(Server& server, Server::VolumeNumber volume = {}) const { server.open(*atlas, low ? &*low : nullptr, volume); }
};

/// Volumes other than the first, opened when their pages are loaded, one after the other.
class OtherVolumes {
public:
    OtherVolumes(std::shared_ptr<const Several> several, Terminal& terminal) : several_(std::move(several)), terminal_(terminal) {}

    /// From any thread; returns at once.
    void want(std::int64_t volume);
    /// Opens what is wanted until it is told to stop, or the user interrupts. The server must have begun, and end before this.
    void run(const std::stop_token& stop, Server& server);

private:
    struct Opened {
        std::int64_t volume;
        std::unique_ptr<Viewed> viewed;
    };
    [[nodiscard]] bool is_open(std::int64_t volume);
    void open(std::int64_t volume, Server& server);
    void close_unused(Server& server);

    std::shared_ptr<const Several> several_;
    Terminal& terminal_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::vector<std::int64_t> wanted_;
    std::list<Opened> opened_;  ///< that which was wanted last in front; of run() alone
};

}  // namespace isoatlas::cli
