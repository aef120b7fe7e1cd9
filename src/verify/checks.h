// A named check: holds until a violation is reported.
#pragma once

#include <string>

#include "isoatlas/verify.h"

namespace isoatlas {

class Check {
public:
    explicit Check(std::string name) : name_(std::move(name)) {}

    /// Keeps the first violation; later ones are counted.
    void fail(const std::string& offender) {
        if (failures_++ == 0) offender_ = offender;
    }
    [[nodiscard]] bool holds() const { return failures_ == 0; }

    /// `counted`: the checked items, "1234 events".
    [[nodiscard]] CheckResult result(const std::string& counted) const {
        if (holds()) return {name_, true, counted};
        return {name_, false, offender_ + (failures_ > 1 ? " (and " + std::to_string(failures_ - 1) + " more)" : "") + "; " + counted};
    }

private:
    std::string name_, offender_;
    long long failures_ = 0;
};

}  // namespace isoatlas
