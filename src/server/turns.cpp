#include "server/turns.h"

#include "isoatlas/error.h"

namespace isoatlas::server {

bool Turns::is_over(const std::string& client, std::uint64_t number) const {
    const auto newest = newest_.find(client);
    return ended_ || (newest != newest_.end() && newest->second > number);
}

bool Turns::Turn::is_over() const {
    const std::lock_guard lock(turns_.mutex_);
    return turns_.is_over(client_, number_);
}

Turns::Turn::~Turn() {
    const std::lock_guard lock(turns_.mutex_);
    const auto newest = turns_.newest_.find(client_);
    if (newest != turns_.newest_.end() && newest->second == number_) turns_.newest_.erase(newest);
    turns_.running_ -= running_;
    turns_.changed_.notify_all();
}

std::unique_ptr<Turns::Turn> Turns::take(const std::string& client) {
    std::unique_lock lock(mutex_);
    if (static_cast<int>(waiting_.size()) >= most_waiting_) {
        throw Error(ErrorKind::resource, {.what = "too many questions wait for an answer", .next = "ask again later"});
    }
    const std::uint64_t number = ++questions_;
    if (!client.empty()) newest_[client] = number;
    std::unique_ptr<Turn> turn(new Turn(*this, client, number));  // the constructor is private
    changed_.notify_all();                                        // an older question that waits
    waiting_.insert(number);
    changed_.wait(lock, [&] { return (running_ < at_once_ && *waiting_.begin() == number) || is_over(client, number); });
    waiting_.erase(number);
    changed_.notify_all();  // the next one
    if (is_over(client, number)) {
        lock.unlock();  // the turn ends
        throw Error(ErrorKind::cancelled, {.what = "a newer question came"});
    }
    ++running_;
    turn->running_ = true;
    return turn;
}

int Turns::waiting() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(waiting_.size());
}

void Turns::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
}

}  // namespace isoatlas::server
