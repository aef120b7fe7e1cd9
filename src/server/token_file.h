// Path of the file with the token of a server, for other programs of its user: base/private_file.h.
#pragma once

#include <string>

namespace isoatlas {

[[nodiscard]] inline std::string token_file(int port) { return "viewer-" + std::to_string(port); }

}  // namespace isoatlas
