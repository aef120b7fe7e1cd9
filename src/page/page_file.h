// A page as a file: the bundle of web/ with its data.
#pragma once

#include <cstdint>
#include <string>

#include "isoatlas/page.h"

namespace isoatlas {

/// Throws Error{usage}.
void check_page_options(const PageOptions& options);

/// Throws Error{unsupported} when there are no pages in this program.
void check_has_pages();

/// json: the data. Returns the size in bytes. Throws Error: resource.
/// Bytes of kMaxPageBytes that a page with this JSON leaves for meshes; negative: none.
[[nodiscard]] std::int64_t bytes_for_meshes(const std::string& json, std::int64_t meshes);
std::int64_t write_page_file(const std::string& path, const std::string& json);

}  // namespace isoatlas
