// Local numbers of the extrema that a part refers to: its own range first, then those of other parts.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isoatlas {

template <class Id>
class LocalNumbers {
public:
    /// first, end: the part's own range. foreign: the others that it refers to, in any order, also several times.
    LocalNumbers(Id first, Id end, std::vector<Id> foreign) : first_(first), own_(end - first), foreign_(std::move(foreign)) {
        std::sort(foreign_.begin(), foreign_.end());
        foreign_.erase(std::unique(foreign_.begin(), foreign_.end()), foreign_.end());
    }
    [[nodiscard]] std::size_t size() const { return own_ + foreign_.size(); }
    [[nodiscard]] bool is_own(Id number) const { return number - first_ < own_; }  // wraps around below the range
    [[nodiscard]] Id own() const { return own_; }
    [[nodiscard]] Id local(Id number) const {
        if (is_own(number)) return number - first_;
        return own_ + static_cast<Id>(std::lower_bound(foreign_.begin(), foreign_.end(), number) - foreign_.begin());
    }
    [[nodiscard]] Id global(Id local) const { return local < own_ ? first_ + local : foreign_[local - own_]; }

private:
    Id first_, own_;
    std::vector<Id> foreign_;
};

}  // namespace isoatlas
