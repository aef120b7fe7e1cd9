// Lazy: a value computed once, on first access, from any thread.
#pragma once

#include <mutex>

namespace isoatlas {

template <class T>
class Lazy {
public:
    template <class Make>
    [[nodiscard]] const T& get(const Make& make) const {
        std::call_once(once_, [&] { value_ = make(); });
        return value_;
    }

private:
    mutable std::once_flag once_;
    mutable T value_{};
};

}  // namespace isoatlas
