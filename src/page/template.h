// The pages without their data: web/, each bundled into one file when isoatlas is built; empty when it was built without them.
#pragma once

#include <string_view>

namespace isoatlas {

/// What `isoatlas FILE` writes.
[[nodiscard]] std::string_view page_template();
/// What `isoatlas view` serves.
[[nodiscard]] std::string_view viewer_template();

}  // namespace isoatlas
