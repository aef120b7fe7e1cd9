// Data that most responses need and every page requests first: computed once, on the first request or before.
#pragma once

#include <string>
#include <vector>

#include "catalogue/page_contents.h"
#include "isoatlas/atlas.h"
#include "server/object_words.h"
#include "server/sample_answers.h"

namespace isoatlas {

struct StoreCatalogue {
    PageContents contents;
    BranchHierarchy hierarchy;
    std::vector<NamedEntry> entries;
    NumberedLines lines;
    std::vector<std::int64_t> number_of_rank;  ///< of the first line of an object in the table, from 1; 0: none
    std::string atlas, transfer;               ///< the responses to these requests
};

/// Throws Error: input (damaged store), cancelled. Cost: overview_of() (atlas/overview.h) and page_contents(); of noise some seconds for
/// 256^3 samples. The trees are read.
[[nodiscard]] StoreCatalogue load_catalogue(const Atlas& atlas, const Context& context);

}  // namespace isoatlas
