// Client: requests to a running `isoatlas view`, from the command line and from programs.
#pragma once

#include <string>

namespace isoatlas {

struct ServerResponse {
    std::string type;   ///< such as "application/json"
    std::string bytes;  ///< text of a JSON document, a mesh, a file: docs/server.md
};

/// address: http://127.0.0.1:PORT, or PORT alone; the token is that of the environment, ISOATLAS_TOKEN, else of the file in which a viewer
/// of this user keeps it. A program that has it writes http://127.0.0.1:PORT/?token=TOKEN, which does not belong on a command line.
/// request: a path with its query parameters, such as /api/objects?tau=100. Waits for the response. Throws the Error that the server
/// responds with; also usage (not the address of a viewer, a request without an end), input (connection refused, token unknown).
[[nodiscard]] ServerResponse ask_server(const std::string& address, const std::string& request);

/// The same into a file, which appears whole or not at all. Returns its bytes. Throws also Error{resource}.
std::size_t ask_server(const std::string& address, const std::string& request, const std::string& path);

}  // namespace isoatlas
