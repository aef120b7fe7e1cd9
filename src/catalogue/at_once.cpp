#include "catalogue/at_once.h"

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "catalogue/shared_context.h"

namespace isoatlas {

void at_once(const Context& context, const std::function<void(const Context&)>& first, const std::function<void(const Context&)>& second) {
    const SharedContext shared(context);
    run_both(memory_is_limited() ? 1 : context.threads, [&] { first(shared.context()); }, [&] { second(shared.context()); });
}

}  // namespace isoatlas
