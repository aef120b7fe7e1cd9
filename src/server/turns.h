// Whose turn it is: a few surfaces are made at a time, others wait in the order in which they came; a newer question of the same client
// ends an older one, and takes its place where that still waits. A question ends too when who asked has left.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/changes.h"

namespace isoatlas {

/// Is nobody there any more to hear the answer? Asked now and then, from the thread that waits or works. Empty: somebody is.
using Left = std::function<bool()>;

class Turns {
public:
    /// at_once: so many hold a turn; waiting: so many more may wait for one. changes: is told of every change; it must live as long.
    Turns(int at_once, int waiting, Changes* changes = nullptr) : at_once_(at_once), most_waiting_(waiting), changes_(changes) {}

    /// Held while a surface is made.
    class Turn {
    public:
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn();
        /// Has a newer question of the same client come, has who asked left, or does the server end?
        [[nodiscard]] bool is_over();
        /// How much of the work is done, 0 to 1.
        void tell(double fraction);

    private:
        friend class Turns;
        Turn(Turns& turns, std::string client, Left left) : turns_(turns), client_(std::move(client)), left_(std::move(left)) {}

        Turns& turns_;
        const std::string client_;
        const Left left_;
        // under the mutex of turns_:
        std::uint64_t place_ = 0;  ///< in the order of waiting; 0: it does not wait
        double fraction_ = 0;
        bool running_ = false, ended_ = false;
    };

    /// Waits until it is this client's turn. Throws Error: cancelled (a newer question came, who asked has left, or the server ends),
    /// resource (too many wait). An empty client is one of its own each time.
    [[nodiscard]] std::unique_ptr<Turn> take(const std::string& client, Left left = {});
    /// Ends what a client has asked: the questions of NAME and of NAME/ANYTHING.
    void leave(const std::string& name);
    /// Ends all turns; take() refuses from now on.
    void end();

    /// How many wait.
    [[nodiscard]] int waiting() const;
    [[nodiscard]] int running() const;

    /// A question that is not yet answered.
    struct Pending {
        std::string client;
        int place = 0;        ///< in the queue, from 1; 0: its answer is being made
        double fraction = 0;  ///< of that
    };
    /// Those of NAME and of NAME/ANYTHING, by client.
    [[nodiscard]] std::vector<Pending> pending(const std::string& name) const;

private:
    [[nodiscard]] bool may_run(const Turn& turn) const;
    /// The turn no longer waits.
    void call_up(Turn& turn);
    void tell_all();

    const int at_once_, most_waiting_;
    Changes* const changes_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Turn*> turns_;                ///< that live
    std::map<std::uint64_t, Turn*> waiting_;  ///< by place
    std::uint64_t places_ = 0;
    int running_ = 0;
    bool ended_ = false;
};

}  // namespace isoatlas
