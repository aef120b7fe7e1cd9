// The first of several unequal things, named: what a failed comparison prints.
#pragma once

#include <sstream>
#include <string>

#include "oracle/oracle.h"

namespace oracle {

template <class T>
std::string join(const T& list) {
    std::ostringstream out;
    out.precision(17);
    for (const auto& item : list) out << item << ' ';
    return out.str();
}

/// Of a list of ids (isoatlas/id.h).
template <class T>
std::vector<Index> numbers_of(const T& ids) {
    std::vector<Index> numbers;
    for (const auto id : ids) numbers.push_back(id.number());
    return numbers;
}

/// The first pair of unequal things, named.
class Difference {
public:
    explicit Difference(std::string where) {
        where_ << where;
        where_.precision(17);
    }
    template <class A, class B>
    Difference& check(const char* name, const A& expected, const B& actual) {
        if (text_.empty() && !(expected == actual)) {
            std::ostringstream out;
            out.precision(17);
            out << where_.str() << ": " << name << " should be " << expected << ", is " << actual;
            text_ = out.str();
        }
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::ostringstream where_;
    std::string text_;
};

inline std::string at(const char* what, Index i) { return std::string(what) + " " + std::to_string(i); }

}  // namespace oracle
