#include "server/job_queues.h"

namespace isoatlas {
namespace {

constexpr int kMaxWaiting = 256, kMaxCards = 16;
constexpr std::array<const char*, 5> kNames{"surfaces", "samples", "trees", "cards", "atlas"};

}  // namespace

JobQueues::JobQueues(VersionCounter& changes)
    : queues_{JobQueue{2, kMaxWaiting, &changes}, JobQueue{2, kMaxWaiting, &changes}, JobQueue{4, kMaxWaiting, &changes},
              JobQueue{1, kMaxCards, &changes}, JobQueue{kMaxWaiting, kMaxWaiting, &changes}} {}

void JobQueues::leave(const std::string& name) {
    for (JobQueue& line : queues_) line.leave(name);
}

void JobQueues::end() {
    for (JobQueue& line : queues_) line.end();
}

std::vector<JobQueues::Pending> JobQueues::pending(const std::string& name) const {
    std::vector<Pending> found;
    for (std::size_t i = 0; i < queues_.size(); ++i) {
        for (JobQueue::Pending& request : queues_[i].pending(name)) found.push_back({kNames[i], std::move(request)});
    }
    return found;
}

}  // namespace isoatlas
