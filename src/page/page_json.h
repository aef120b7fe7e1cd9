// The data of a page as JSON: docs/schema/page.schema.json.
#pragma once

#include <string>

#include "catalogue/page_contents.h"
#include "formats/common/json_stream.h"

namespace isoatlas {

/// A store as commands name it: as a word, one of both polarities with the option of the one that is open.
[[nodiscard]] std::string command_source(const Atlas& atlas, const std::string& source);

/// null: nothing was drawn.
/// The member "mesh".
void write_mesh(JsonStream& json, const PageMesh& mesh);
void write_picture(JsonStream& json, const Turntable& picture);

/// source: file named in commands.
void write_page_json(JsonStream& json, const StoreSides& sides, const PageContents& contents, const std::string& source);

}  // namespace isoatlas
