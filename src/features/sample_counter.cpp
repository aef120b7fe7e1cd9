#include "features/sample_counter.h"

#include <algorithm>

namespace isoatlas {
namespace {

constexpr double kEqual = 0.95, kEqualInside = 0.5, kSkipping = 0.1;

double part_of(std::int64_t some, std::int64_t all) { return all == 0 ? 0 : static_cast<double>(some) / static_cast<double>(all); }

}  // namespace

std::size_t SampleCounter::place_of(double value) {
    if (values_.empty() || values_[last_].value != value) {
        const auto place = std::ranges::lower_bound(ascending_, value, {}, [&](std::size_t i) { return values_[i].value; });
        if (place != ascending_.end() && values_[*place].value == value) {
            last_ = *place;
        } else if (values_.size() < kMost) {
            last_ = values_.size();
            ascending_.insert(place, last_);
            values_.push_back({value});
            unequal_.resize(kMost * kMost);
        } else {
            has_few_ = false;
            return kMost;
        }
    }
    return last_;
}

SampleSurvey SampleCounter::survey() const {
    SampleSurvey found = ends_;
    if (!has_few_) return found;
    found.values = values_.size();
    if (values_.empty()) return found;
    const auto commonest = std::ranges::max_element(values_, {}, &Value::count);
    std::int64_t equal = 0, skipping = 0;
    for (const Value& value : values_) equal += value.pairs;
    for (std::size_t i = 0; i < ascending_.size(); ++i) {
        for (std::size_t j = i + 2; j < ascending_.size(); ++j) {
            const auto [first, second] = std::minmax(ascending_[i], ascending_[j]);
            skipping += unequal_[first * kMost + second];
        }
    }
    LabelLikeness& like = found.likeness;
    like.equal = part_of(equal, pairs_);
    like.equal_inside = part_of(equal - commonest->pairs, pairs_ - commonest->pairs);
    like.skipping = part_of(skipping, pairs_ - equal);
    const bool are_whole =
        std::ranges::all_of(values_, [](const Value& value) { return value.value >= 0 && value.value == std::floor(value.value); });
    like.are_labels = are_whole && found.values >= 3 && found.missing == 0 && like.equal > kEqual && like.equal_inside > kEqualInside &&
                      like.skipping >= kSkipping;
    return found;
}

}  // namespace isoatlas
