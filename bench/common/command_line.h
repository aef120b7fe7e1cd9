// The command line of a benchmark: words, and options that begin with --.
#pragma once

#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace bench {

class CommandLine {
public:
    /// An option without a value.
    CommandLine& flag(const std::string& name, const std::function<void()>& set) {
        known_.push_back({name, false, [set](const std::string&) { set(); }});
        return *this;
    }
    CommandLine& flag(const std::string& name, bool& place) {
        return flag(name, [&place] { place = true; });
    }
    /// An option with a value: a text or a number.
    template <class T>
    CommandLine& value(const std::string& name, T& place) {
        known_.push_back({name, true, [&place](const std::string& text) {
                              if constexpr (std::is_same_v<T, std::string>)
                                  place = text;
                              else if constexpr (std::is_floating_point_v<T>)
                                  place = std::stod(text);
                              else
                                  place = static_cast<T>(std::stoll(text));
                          }});
        return *this;
    }
    /// Sets the places, and returns the other words. Throws std::runtime_error.
    [[nodiscard]] std::vector<std::string> read(int argc, char** argv) const {
        std::vector<std::string> words;
        for (int i = 1; i < argc; ++i) {
            const std::string word = argv[i];
            if (!word.starts_with("--")) {
                words.push_back(word);
                continue;
            }
            const Known& option = find(word);
            if (option.has_value && ++i == argc) throw std::runtime_error(word + " needs a value");
            option.set(option.has_value ? argv[i] : "");
        }
        return words;
    }

private:
    struct Known {
        std::string name;
        bool has_value;
        std::function<void(const std::string&)> set;
    };
    [[nodiscard]] const Known& find(const std::string& word) const {
        for (const Known& option : known_) {
            if (option.name == word) return option;
        }
        throw std::runtime_error("unknown option " + word);
    }
    std::vector<Known> known_;
};

/// On the clock.
template <class Work>
double seconds_of(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace bench
