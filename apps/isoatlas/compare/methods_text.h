// docs/methods.md, as it was when this program was built: the page of `compare` says what each method does in its words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/methods.h"

namespace isoatlas {

[[nodiscard]] std::string_view methods_text();

namespace cli {

struct MethodSection {
    std::string title;    ///< "Octree, and branch-on-need octree (3.7.1)"
    std::string section;  ///< of the dissertation: "3.7.1"
    std::string html;     ///< its paragraphs, lists and tables
    std::string anchor;   ///< "octree-and-branch-on-need-octree-371"
};
/// Those about a method, in the order of the document.
[[nodiscard]] const std::vector<MethodSection>& method_sections();
/// The one about a method: of its section of the dissertation, with the most words of its title. nullptr: none.
[[nodiscard]] const MethodSection* section_about(const ComparedMethod& method);

}  // namespace cli
}  // namespace isoatlas
