// The objects of high and of low values of a store on one page.
#pragma once

#include "catalogue/page_contents.h"
#include "catalogue/store_sides.h"

namespace isoatlas {

/// rank_together() of both tables (docs/theory/9-low-values.md#one-list), at most options.top lines, as entries in that order. What is
/// enclosed is an object of low values (PageEntry::around); no cavities. high and low: overview_of() of sides.main and *sides.low.
/// Cost: page_contents() of both.
[[nodiscard]] PageContents joined_contents(const StoreSides& sides, const Overview& high, const Overview& low, const PageOptions& options,
                                           const Context& context);

}  // namespace isoatlas
