// All bright objects of a store, for a reader who chooses among them: /api/branches.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/lazy.h"
#include "isoatlas/atlas.h"
#include "page/contents.h"
#include "server/words.h"

namespace isoatlas::server {

/// Every question must be about the same store.
class Branches {
public:
    /// docs/schema/server-branches. Throws Error{usage} for words it does not know. Cost: the first call that of Atlas::hierarchy(); then
    /// O(branches).
    [[nodiscard]] std::string json(const Atlas& atlas, Words& words, const Context& context) const;
    /// A branch as large as it gets on its own: just above the value at which it merges; the trunk in the middle of its isovalues.
    /// Throws Error{not_found}.
    [[nodiscard]] page::PageEntry entry(const Atlas& atlas, std::int64_t rank, const Context& context) const;

    /// Answers list at most so many.
    static constexpr std::int64_t kMostListed = 20'000;

private:
    [[nodiscard]] const BranchHierarchy& hierarchy(const Atlas& atlas, const Context& context) const;

    Lazy<std::unique_ptr<BranchHierarchy>> hierarchy_;
};

}  // namespace isoatlas::server
