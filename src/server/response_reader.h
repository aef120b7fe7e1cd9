// Parses HTTP responses of an isoatlas server from the bytes of a connection.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace isoatlas {

class ResponseReader {
public:
    ResponseReader();
    ~ResponseReader();

    /// Parses the next received bytes. False: not an HTTP response. Throws std::bad_alloc.
    [[nodiscard]] bool read(std::string_view bytes);
    /// The response is complete.
    [[nodiscard]] bool is_whole() const;
    [[nodiscard]] int status() const;
    [[nodiscard]] std::string type() const;
    [[nodiscard]] std::string& body();

private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    std::string rest_;  ///< not yet parsed
};

}  // namespace isoatlas
