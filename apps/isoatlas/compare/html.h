// Text inside an HTML document.
#pragma once

#include <string>
#include <string_view>

#include <isoatlas/image.h>

namespace isoatlas::cli {

/// As content or inside double quotes. Bytes that are not UTF-8 become \xe4.
[[nodiscard]] std::string html_text(std::string_view text);
/// A paragraph of Markdown: `code`, *emphasis*; of links their words.
[[nodiscard]] std::string html_of_markdown(std::string_view paragraph);
/// "data:image/webp;base64,..."
[[nodiscard]] std::string data_address(const Image& image);

}  // namespace isoatlas::cli
