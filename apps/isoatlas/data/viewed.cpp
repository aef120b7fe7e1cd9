#include "data/viewed.h"

#include <algorithm>

#include "data/assume_inputs.h"
#include "data/session.h"
#include "data/sides.h"
#include "data/store_awaited.h"
#include "text/advice.h"
#include "text/interrupt.h"
#include "text/terminal.h"

namespace isoatlas::cli {
namespace {

constexpr std::size_t kMaxOpen = 8;  ///< others that stay open though no page shows them

/// The viewer is about isovalues, which mean nothing between labels.
[[noreturn]] void refuse_labels(const Arguments& arguments) {
    const std::string file = shell_word(arguments.file) + reading_options(arguments);
    throw Error(ErrorKind::usage, {.file = arguments.file,
                                   .what = "the samples look like labels, and the viewer shows objects at isovalues",
                                   .next = "isoatlas " + file + " makes a page with a card for each label; isoatlas render " + file +
                                           " draws them; --labels no views the samples as values"});
}

}  // namespace

Viewed::Viewed(Arguments own) : arguments(std::move(own)) {
    if (arguments.inputs.are_labels) refuse_labels(arguments);
    store = store_to_view(arguments);
}

void Viewed::open() {
    AtlasOptions options{.cache_bytes = arguments.memory, .polarity = arguments.side()};
    if (store == arguments.file) options.corrections = corrections_of(arguments);
    atlas.emplace(store, options);
    if (arguments.side() || atlas->polarities() != PolarityChoice::both) return;
    AtlasOptions of_low = options;
    of_low.polarity = Polarity::low;
    low.emplace(store, of_low);
}

void OtherVolumes::want(std::int64_t volume) {
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(wanted_, volume) == wanted_.end()) wanted_.push_back(volume);
    changed_.notify_all();
}

bool OtherVolumes::is_open(std::int64_t volume) {
    const auto found = std::ranges::find(opened_, volume, &Opened::volume);
    if (found == opened_.end()) return false;
    opened_.splice(opened_.begin(), opened_, found);
    return true;
}

void OtherVolumes::open(std::int64_t volume, Server& server) {
    try {
        Arguments own = of_volume(*several_, volume);
        assume_inputs(own, terminal_);
        auto viewed = std::make_unique<Viewed>(with_sides(own));
        const auto report = [&](const BuildState& state) { server.report_progress(state, volume); };
        if (!is_ready(viewed->arguments, terminal_, viewed->store)) await_store(viewed->arguments, terminal_, viewed->store, report);
        viewed->open();
        check_is_volume(viewed->arguments, viewed->atlas->info());
        viewed->show(server, volume);
        opened_.push_front({volume, std::move(viewed)});
        Context context;
        context.cancelled = interrupted;
        server.prepare(context, volume);
    } catch (const Error& error) {
        if (!interrupted()) server.fail(with_options(error), volume);
    }
}

void OtherVolumes::close_unused(Server& server) {
    for (auto at = opened_.end(); opened_.size() > kMaxOpen && at != opened_.begin();) {
        const auto last = std::prev(at);
        at = server.close(last->volume) ? opened_.erase(last) : last;
    }
}

void OtherVolumes::run(const std::stop_token& stop, Server& server) {
    while (!interrupted()) {
        std::int64_t volume = 0;
        {
            std::unique_lock lock(mutex_);
            if (!changed_.wait(lock, stop, [this] { return !wanted_.empty(); })) return;
            volume = wanted_.back();  // what somebody waits for now
            wanted_.pop_back();
        }
        if (!is_open(volume)) open(volume, server);
        close_unused(server);
    }
}

}  // namespace isoatlas::cli
