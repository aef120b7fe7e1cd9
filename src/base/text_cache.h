// TextCache: computed texts by name; the oldest ones are evicted.
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>

namespace isoatlas {

/// Thread safe.
class TextCache {
public:
    explicit TextCache(std::size_t max) : max_(max) {}

    [[nodiscard]] std::optional<std::string> find(const std::string& name) const {
        const std::lock_guard lock(mutex_);
        const auto text = texts_.find(name);
        return text == texts_.end() ? std::nullopt : std::optional(text->second);
    }
    /// The first text of a name stays.
    void keep(const std::string& name, const std::string& text) {
        const std::lock_guard lock(mutex_);
        if (!texts_.emplace(name, text).second) return;
        oldest_first_.push_back(name);
        if (oldest_first_.size() <= max_) return;
        texts_.erase(oldest_first_.front());
        oldest_first_.pop_front();
    }

private:
    std::size_t max_;
    mutable std::mutex mutex_;
    std::map<std::string, std::string> texts_;
    std::deque<std::string> oldest_first_;
};

}  // namespace isoatlas
