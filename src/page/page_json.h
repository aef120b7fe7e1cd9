// The data of a page as JSON: docs/schema/page.schema.json.
#pragma once

#include <string>

#include "catalogue/page_contents.h"
#include "formats/common/json_stream.h"

namespace isoatlas {

/// source: file named in commands.
void write_page_json(JsonStream& json, const Atlas& atlas, const PageContents& contents, const std::string& source);

}  // namespace isoatlas
