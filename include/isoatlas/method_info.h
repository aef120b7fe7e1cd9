// What is known of a method of the literature before it runs.
#pragma once

#include <string_view>

namespace isoatlas {

/// Method: an enumeration, SearchMethod or SurfaceMethod.
template <class Method>
struct MethodInfo {
    Method method;
    std::string_view name;     ///< "interval-tree"
    std::string_view title;    ///< "Interval tree"
    std::string_view section;  ///< of the dissertation; empty: none
    std::string_view source;   ///< authors, title, year
    std::string_view cost;     ///< of a query or an extraction, as its source states it: n cells, k of them active
};

}  // namespace isoatlas
