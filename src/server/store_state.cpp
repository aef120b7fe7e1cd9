#include "server/store_state.h"

namespace isoatlas {

template <class Change>
void StoreState::change(const Change& apply) {
    {
        const std::lock_guard lock(mutex_);
        apply();
    }
    changes_.note();
}

void StoreState::open(const Atlas& atlas, const Atlas* low) {
    change([&] { atlas_ = &atlas, low_ = low; });
}

void StoreState::report_progress(const BuildState& state) {
    change([&] { build_ = state, failure_.reset(); });
}

void StoreState::fail(const Error& error) {
    change([&] { failure_ = error; });
}

StoreSides StoreState::sides() const {
    const std::lock_guard lock(mutex_);
    if (atlas_ != nullptr) return {*atlas_, low_};
    if (failure_) throw *failure_;
    throw Error(ErrorKind::resource, {.what = "the store is being built", .next = "/api/events reports the progress"});
}

StoreState::State StoreState::state() const {
    const std::lock_guard lock(mutex_);
    return {atlas_ != nullptr, build_, failure_};
}

}  // namespace isoatlas
