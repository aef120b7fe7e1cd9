// Whose turn it is: a few surfaces are made at a time, others wait in the order in which they came; a newer question of the same client
// ends an older one.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace isoatlas::server {

class Turns {
public:
    /// at_once: so many hold a turn; waiting: so many more may wait for one.
    Turns(int at_once, int waiting) : at_once_(at_once), most_waiting_(waiting) {}

    /// Held while a surface is made.
    class Turn {
    public:
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn();
        /// Has a newer question of the same client come, or does the server end?
        [[nodiscard]] bool is_over() const;

    private:
        friend class Turns;
        Turn(Turns& turns, std::string client, std::uint64_t number) : turns_(turns), client_(std::move(client)), number_(number) {}
        Turns& turns_;
        std::string client_;
        std::uint64_t number_;
        bool running_ = false;
    };

    /// Waits until it is this client's turn. Throws Error: cancelled (a newer question came, or the server ends), resource (too many wait).
    /// An empty client is one of its own each time.
    [[nodiscard]] std::unique_ptr<Turn> take(const std::string& client);
    /// How many wait.
    [[nodiscard]] int waiting() const;
    /// Ends all turns; take() refuses from now on.
    void end();

private:
    [[nodiscard]] bool is_over(const std::string& client, std::uint64_t number) const;

    int at_once_, most_waiting_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, std::uint64_t> newest_;  ///< per client that has a question
    std::uint64_t questions_ = 0;
    std::set<std::uint64_t> waiting_;  ///< numbers of questions
    int running_ = 0;
    bool ended_ = false;
};

}  // namespace isoatlas::server
