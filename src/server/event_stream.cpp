#include "server/event_stream.h"

#include "isoatlas/error.h"
#include "server/answers.h"
#include "server/shared_scene.h"

namespace isoatlas {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kMaxStreams = 64;
constexpr milliseconds kStreamPoll{250};  ///< polling interval of a waiting stream for a disconnected client
constexpr milliseconds kApart{100};       ///< between two messages
constexpr milliseconds kHeartbeat{5000};  ///< max interval between messages (comments): keeps proxies from closing the connection

}  // namespace

EventStream::EventStream(EventStreams& streams, std::string client, IsDisconnected is_disconnected)
    : streams_(streams), client_(std::move(client)), is_disconnected_(std::move(is_disconnected)) {}

EventStream::~EventStream() {
    bool last = false;
    {
        const std::lock_guard lock(streams_.mutex_);
        streams_.clients_.erase(streams_.clients_.find(client_));
        last = !streams_.clients_.contains(client_);
    }
    if (last && !client_.empty()) streams_.queues_.leave(client_);
}

std::string EventStream::state() const {
    std::vector<JobQueues::Pending> pending;
    if (!client_.empty()) pending = streams_.queues_.pending(client_);
    return events_json(streams_.store_state_.state(), pending, streams_.scene_.version());
}

std::string EventStream::next() {
    while (!streams_.ended_ && !(is_disconnected_ && is_disconnected_())) {
        const auto now = std::chrono::steady_clock::now();
        const std::uint64_t count = streams_.changes_.count();
        if (now - last_ < kApart) {
            streams_.changes_.pause(std::chrono::duration_cast<milliseconds>(kApart - (now - last_)) + milliseconds(1));
            continue;
        }
        if (told_.empty() || count != seen_) {
            seen_ = count;
            std::string text = state();
            if (text != told_) {
                told_ = text;
                last_ = now;
                return "event: state\ndata: " + text + "\n\n";
            }
        }
        if (now - last_ >= kHeartbeat) {
            last_ = now;
            return ":\n\n";
        }
        streams_.changes_.wait(seen_, kStreamPoll);
    }
    return {};
}

std::shared_ptr<EventStream> EventStreams::listen(const std::string& client, IsDisconnected is_disconnected) {
    const std::lock_guard lock(mutex_);
    if (clients_.size() >= kMaxStreams)
        throw Error(ErrorKind::resource,
                    {.what = "too many event streams", .next = "close a page that shows this volume, then load this one again"});
    clients_.insert(client);
    return std::shared_ptr<EventStream>(new EventStream(*this, client, std::move(is_disconnected)));  // the constructor is private
}

void EventStreams::end() {
    ended_ = true;
    changes_.note();
}

}  // namespace isoatlas
