#include "data/network.h"

#include <cstdlib>

#include <fmt/format.h>
#include <isoatlas/remote.h>

#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
void use_network(const Arguments& arguments) {
    RemoteOptions options;
    if (arguments.cache) options.disk_cache = *arguments.cache;
    const char* token = std::getenv("ISOATLAS_BEARER_TOKEN");  // NOLINT(concurrency-mt-unsafe): nobody sets it
    if (token != nullptr) options.token = token;
    options.cancelled = interrupted;
    use_remote_files(options);
}

void tell_traffic(Terminal& terminal) {
    const RemoteTraffic traffic = remote_traffic();
    if (traffic.requests == 0 && traffic.from_disk == 0) return;
    terminal.detail(fmt::format("network: {} in {}, {}{}; {} from the cache on disk", counted(traffic.requests, "request"),
                                counted(traffic.round_trips, "round trip"), bytes_text(static_cast<double>(traffic.bytes)),
                                traffic.repeated > 0 ? fmt::format(" ({} repeated)", traffic.repeated) : "",
                                bytes_text(static_cast<double>(traffic.from_disk))));
}

}  // namespace isoatlas::cli
