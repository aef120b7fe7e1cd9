#include "server/job_queue.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string_view>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::chrono::milliseconds kJobPoll{100};  ///< polling interval of a waiting job for a disconnected client
constexpr double kTold = 0.01;                      ///< smaller progress is not reported

bool is_of(std::string_view client, std::string_view name) {
    return client.starts_with(name) && (client.size() == name.size() || client[name.size()] == '/');
}

}  // namespace

bool JobQueue::Job::is_cancelled() {
    {
        const std::lock_guard lock(jobs_.mutex_);
        if (ended_ || jobs_.ended_) return true;
    }
    return is_disconnected_ && is_disconnected_();
}

void JobQueue::Job::report_progress(double fraction) {
    const std::lock_guard lock(jobs_.mutex_);
    if (fraction < fraction_ + kTold) return;
    fraction_ = fraction;
    if (jobs_.changes_ != nullptr) jobs_.changes_->note();
}

JobQueue::Job::~Job() {
    const std::lock_guard lock(jobs_.mutex_);
    std::erase(jobs_.jobs_, this);
    jobs_.running_ -= running_;
    jobs_.notify_waiting();
}

bool JobQueue::may_run(const Job& job) const { return running_ < max_running_ && waiting_.begin()->second == &job; }

void JobQueue::activate(Job& job) {
    if (job.place_ > 0) waiting_.erase(job.place_);
    job.place_ = 0;
}

void JobQueue::notify_waiting() {
    changed_.notify_all();
    if (changes_ != nullptr) changes_->note();
}

std::unique_ptr<JobQueue::Job> JobQueue::acquire(const std::string& client, IsDisconnected is_disconnected) {
    std::unique_lock lock(mutex_);
    std::uint64_t place = 0;
    for (Job* other : jobs_) {
        if (client.empty() || other->client_ != client) continue;
        other->ended_ = true;
        if (other->place_ > 0) place = other->place_;
        activate(*other);
    }
    if (static_cast<int>(waiting_.size()) >= max_waiting_) {
        throw Error(ErrorKind::resource, {.what = "too many requests are waiting", .next = "retry later"});
    }
    std::unique_ptr<Job> job(new Job(*this, client, std::move(is_disconnected)));  // the constructor is private
    job->place_ = place > 0 ? place : ++next_place_;
    jobs_.push_back(job.get());
    waiting_.emplace(job->place_, job.get());
    notify_waiting();
    while (!job->ended_ && !ended_ && !may_run(*job)) {
        changed_.wait_for(lock, kJobPoll);
        if (job->is_disconnected_ && job->is_disconnected_()) job->ended_ = true;
    }
    activate(*job);
    if (job->ended_ || ended_) {
        lock.unlock();  // before the job is destroyed
        throw Error(ErrorKind::cancelled, {.what = "superseded by a newer request, or client disconnected"});
    }
    ++running_;
    job->running_ = true;
    notify_waiting();  // the next job
    return job;
}

void JobQueue::leave(const std::string& name) {
    const std::lock_guard lock(mutex_);
    for (Job* job : jobs_) {
        if (is_of(job->client_, name)) job->ended_ = true;
    }
    notify_waiting();
}

void JobQueue::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    notify_waiting();
}

int JobQueue::waiting() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(waiting_.size());
}

int JobQueue::running() const {
    const std::lock_guard lock(mutex_);
    return running_;
}

std::vector<JobQueue::Pending> JobQueue::pending(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    std::vector<Pending> found;
    for (const Job* job : jobs_) {
        if (job->ended_ || !is_of(job->client_, name)) continue;
        const auto place = job->place_ > 0 ? std::distance(waiting_.begin(), waiting_.find(job->place_)) + 1 : 0;
        found.push_back({job->client_, static_cast<int>(place), job->fraction_});
    }
    std::ranges::sort(found, {}, &Pending::client);
    return found;
}

}  // namespace isoatlas
