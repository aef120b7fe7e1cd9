// A loop over large arrays that another function runs: next() once in each step keeps the memory budget.
#pragma once

#include "base/streamed.h"

namespace isoatlas {

class StreamedVisits {
public:
    explicit StreamedVisits(StepBytes step) : step_(step) {}
    void next() { poll_.step(step_.bytes); }

private:
    StepBytes step_;
    BudgetPoll poll_;
};

}  // namespace isoatlas
