// Pictures of objects, rendered on demand, one at a time, and cached: /api/card.
#pragma once

#include <cstdint>
#include <string>

#include "base/text_cache.h"
#include "catalogue/page_contents.h"
#include "isoatlas/atlas.h"
#include "server/job_queue.h"
#include "server/request.h"

namespace isoatlas {

/// The rendered object, and its cache key: "entry 3".
struct CardSubject {
    std::string name;
    bool is_cavity = false;
    Polarity polarity = Polarity::high;
    PageEntry entry{};
};

class Cards {
public:
    /// docs/schema/server-card. frames: of the turntable, 1 to 64. queue: of rendering jobs, one at a time. Throws Error: cancelled,
    /// resource (queue full). Cost: the first time Atlas::extract() and `frames` pictures; one thread.
    [[nodiscard]] std::string json(const Atlas& atlas, const CardSubject& subject, std::int64_t frames, const Request& request,
                                   JobQueue& queue, const Context& context);

private:
    static constexpr std::size_t kMaxKept = 512;  ///< some 30 kB each

    TextCache answers_{kMaxKept};
};

}  // namespace isoatlas
