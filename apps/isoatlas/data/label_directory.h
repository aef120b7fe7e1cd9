// The labels of a label volume, by number or by the name that the file gives them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "data/source.h"
#include "options/object_reference.h"

namespace isoatlas::cli {

class LabelDirectory {
public:
    /// Throws Error{usage} for a store of objects of low values, which has no labels: its samples come negated.
    LabelDirectory(const Arguments& arguments, Source& source);

    /// The labels of references; without any those of the volume: the largest `top` of them (0: all). Throws Error: usage (no label),
    /// not_found (no such label or name; more labels than go into one file).
    [[nodiscard]] std::vector<std::int64_t> find(std::span<const ObjectReference> references, std::int64_t top = 0);

    [[nodiscard]] const std::vector<NamedLabel>& names() const { return names_; }
    /// Empty: none.
    [[nodiscard]] std::string name_of(std::int64_t label) const;
    /// "liver", "label 5"
    [[nodiscard]] std::string title_of(std::int64_t label) const;
    /// That of the file, else the one of object `label`.
    [[nodiscard]] std::array<std::uint8_t, 3> colour_of(std::int64_t label) const;

private:
    [[nodiscard]] std::int64_t label_of(const ObjectReference& reference) const;

    const Arguments& arguments_;
    Source& source_;
    std::vector<NamedLabel> names_;
};

}  // namespace isoatlas::cli
