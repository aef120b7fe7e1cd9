#include "catalogue/at_once.h"

#include <atomic>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "base/parallel.h"

namespace isoatlas {

void at_once(const Context& context, const std::function<void(const Context&)>& first, const std::function<void(const Context&)>& second) {
    const CallerLooks here(context);
    std::atomic<bool> is_cancelled = false;
    Context own = context;
    own.progress = nullptr;
    own.cancelled = [&] {
        if (context.cancelled && here.is_caller() && context.cancelled()) is_cancelled = true;
        return is_cancelled.load();
    };
    run_both(memory_is_limited() ? 1 : context.threads, [&] { first(own); }, [&] { second(own); });
}

}  // namespace isoatlas
