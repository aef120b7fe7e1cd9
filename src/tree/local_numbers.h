// Local numbers of the extrema that a part refers to: its own range first, then those of other parts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isoatlas {

template <class Number>
class LocalNumbers {
public:
    /// first, end: the part's own range. foreign: the others that it refers to, in any order, also several times.
    LocalNumbers(Number first, Number end, std::vector<Number> foreign) : first_(first), own_(end - first), foreign_(std::move(foreign)) {
        std::sort(foreign_.begin(), foreign_.end());
        foreign_.erase(std::unique(foreign_.begin(), foreign_.end()), foreign_.end());
    }
    [[nodiscard]] std::size_t size() const { return own_ + foreign_.size(); }
    [[nodiscard]] bool is_own(Number extremum) const { return extremum - first_ < own_; }  // wraps around below the range
    [[nodiscard]] Number own() const { return own_; }
    [[nodiscard]] Number local(Number extremum) const {
        if (is_own(extremum)) return extremum - first_;
        return own_ + static_cast<Number>(std::lower_bound(foreign_.begin(), foreign_.end(), extremum) - foreign_.begin());
    }
    [[nodiscard]] Number global(Number local) const { return local < own_ ? first_ + local : foreign_[local - own_]; }

private:
    Number first_, own_;
    std::vector<Number> foreign_;
};

}  // namespace isoatlas
