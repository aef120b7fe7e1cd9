// Data that most responses need and every page requests first: computed once, on the first request or before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "catalogue/page_contents.h"
#include "isoatlas/atlas.h"
#include "server/object_words.h"
#include "server/sample_answers.h"

namespace isoatlas {

/// Of one polarity.
struct SideCatalogue {
    BranchHierarchy hierarchy;
    NumberedLines lines;
    std::vector<std::int64_t> number_of_rank;  ///< of the first line of an object in the table, from 1; 0: none
    std::string transfer;                      ///< the response to this request
};

struct StoreCatalogue {
    PageContents contents;
    std::vector<NamedEntry> entries;
    std::string atlas;  ///< the response to this request
    SideCatalogue main;
    std::optional<SideCatalogue> low;  ///< of a store that is open for both

    [[nodiscard]] const SideCatalogue& of(Polarity polarity) const { return low && polarity == Polarity::low ? *low : main; }
};

/// Throws Error: input (damaged store), cancelled. Cost: overview_of() (atlas/overview.h) and page_contents(); of noise some seconds for
/// 256^3 samples. The trees are read.
[[nodiscard]] StoreCatalogue load_catalogue(const StoreSides& sides, const Context& context);

}  // namespace isoatlas
