#include "server/opening.h"

namespace isoatlas {

template <class Change>
void Opening::change(const Change& apply) {
    {
        const std::lock_guard lock(mutex_);
        apply();
    }
    changes_.note();
}

void Opening::open(const Atlas& atlas) {
    change([&] { atlas_ = &atlas; });
}

void Opening::tell(const BuildState& state) {
    change([&] { build_ = state, failure_.reset(); });
}

void Opening::fail(const Error& error) {
    change([&] { failure_ = error; });
}

const Atlas& Opening::atlas() const {
    const std::lock_guard lock(mutex_);
    if (atlas_ != nullptr) return *atlas_;
    if (failure_) throw *failure_;
    throw Error(ErrorKind::resource, {.what = "the store is being built", .next = "ask /api/events how far it is"});
}

Opening::State Opening::state() const {
    const std::lock_guard lock(mutex_);
    return {atlas_ != nullptr, build_, failure_};
}

}  // namespace isoatlas
