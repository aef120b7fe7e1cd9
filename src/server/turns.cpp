#include "server/turns.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string_view>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::chrono::milliseconds kLook{100};  ///< how often one that waits asks whether somebody is still there
constexpr double kTold = 0.01;                   ///< less progress is not worth telling

bool is_of(std::string_view client, std::string_view name) {
    return client.starts_with(name) && (client.size() == name.size() || client[name.size()] == '/');
}

}  // namespace

bool Turns::Turn::is_over() {
    {
        const std::lock_guard lock(turns_.mutex_);
        if (ended_ || turns_.ended_) return true;
    }
    return left_ && left_();
}

void Turns::Turn::tell(double fraction) {
    const std::lock_guard lock(turns_.mutex_);
    if (fraction < fraction_ + kTold) return;
    fraction_ = fraction;
    if (turns_.changes_ != nullptr) turns_.changes_->note();
}

Turns::Turn::~Turn() {
    const std::lock_guard lock(turns_.mutex_);
    std::erase(turns_.turns_, this);
    turns_.running_ -= running_;
    turns_.tell_all();
}

bool Turns::may_run(const Turn& turn) const { return running_ < at_once_ && waiting_.begin()->second == &turn; }

void Turns::call_up(Turn& turn) {
    if (turn.place_ > 0) waiting_.erase(turn.place_);
    turn.place_ = 0;
}

void Turns::tell_all() {
    changed_.notify_all();
    if (changes_ != nullptr) changes_->note();
}

std::unique_ptr<Turns::Turn> Turns::take(const std::string& client, Left left) {
    std::unique_lock lock(mutex_);
    std::uint64_t place = 0;
    for (Turn* other : turns_) {
        if (client.empty() || other->client_ != client) continue;
        other->ended_ = true;
        if (other->place_ > 0) place = other->place_;
        call_up(*other);
    }
    if (static_cast<int>(waiting_.size()) >= most_waiting_) {
        throw Error(ErrorKind::resource, {.what = "too many questions wait for an answer", .next = "ask again later"});
    }
    std::unique_ptr<Turn> turn(new Turn(*this, client, std::move(left)));  // the constructor is private
    turn->place_ = place > 0 ? place : ++places_;
    turns_.push_back(turn.get());
    waiting_.emplace(turn->place_, turn.get());
    tell_all();
    while (!turn->ended_ && !ended_ && !may_run(*turn)) {
        changed_.wait_for(lock, kLook);
        if (turn->left_ && turn->left_()) turn->ended_ = true;
    }
    call_up(*turn);
    if (turn->ended_ || ended_) {
        lock.unlock();  // the turn ends
        throw Error(ErrorKind::cancelled, {.what = "a newer question came, or who asked has left"});
    }
    ++running_;
    turn->running_ = true;
    tell_all();  // the next one
    return turn;
}

void Turns::leave(const std::string& name) {
    const std::lock_guard lock(mutex_);
    for (Turn* turn : turns_) {
        if (is_of(turn->client_, name)) turn->ended_ = true;
    }
    tell_all();
}

void Turns::end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    tell_all();
}

int Turns::waiting() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(waiting_.size());
}

int Turns::running() const {
    const std::lock_guard lock(mutex_);
    return running_;
}

std::vector<Turns::Pending> Turns::pending(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    std::vector<Pending> found;
    for (const Turn* turn : turns_) {
        if (turn->ended_ || !is_of(turn->client_, name)) continue;
        const auto place = turn->place_ > 0 ? std::distance(waiting_.begin(), waiting_.find(turn->place_)) + 1 : 0;
        found.push_back({turn->client_, static_cast<int>(place), turn->fraction_});
    }
    std::ranges::sort(found, {}, &Pending::client);
    return found;
}

}  // namespace isoatlas
