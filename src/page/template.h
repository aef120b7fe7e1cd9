// The page without its data: web/, bundled into one file when isoatlas is built.
#pragma once

#include <string_view>

namespace isoatlas::page {

[[nodiscard]] std::string_view page_template();

}  // namespace isoatlas::page
