#include "server/volume_services.h"

namespace isoatlas {

VolumeServices::VolumeServices(const std::string& token, const ServerOptions& options, const Context& context)
    : token_(token),
      channels_(options.channels),
      first_(options.first),
      wanted_(options.wanted),
      context_(context),
      options_{.memory = options.memory, .is_read_only = options.is_read_only} {
    ServiceOptions of_first = options_;
    of_first.scene = options.scene;
    services_.emplace(first_, std::make_shared<Service>(token_, context_, of_first));
}

bool VolumeServices::has(std::optional<std::int64_t> volume) const {
    const std::int64_t number = number_of(volume);
    return number >= 0 && number < channels_.count();
}

Error VolumeServices::no_such_volume(std::optional<std::int64_t> volume) const {
    return {ErrorKind::not_found,
            {.where = "/volume/" + std::to_string(number_of(volume)),
             .what = "there is no such volume",
             .expected = "less than " + std::to_string(channels_.count()),
             .next = "/api/volumes lists channels and time steps"}};
}

VolumeServices::Use VolumeServices::use(std::optional<std::int64_t> volume, bool is_page) {
    if (!has(volume)) throw no_such_volume(volume);
    const std::int64_t number = number_of(volume);
    Use service;
    bool is_new = false;
    {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<Service>& there = services_[number];
        is_new = there == nullptr;
        if (is_new) there = std::make_shared<Service>(token_, context_, options_);
        if (is_new && is_ended_) there->end();
        service = there;
    }
    if ((is_new || is_page) && number != first_ && wanted_) wanted_(number);
    return service;
}

bool VolumeServices::close(std::int64_t volume) {
    const std::lock_guard lock(mutex_);
    const auto found = services_.find(volume);
    if (found == services_.end()) return true;
    if (volume == first_ || found->second.use_count() > 1) return false;
    services_.erase(found);
    return true;
}

void VolumeServices::end() {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
    for (const auto& [number, service] : services_) service->end();
}

}  // namespace isoatlas
