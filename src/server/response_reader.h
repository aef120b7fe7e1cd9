// What a server of ours answers, read from the bytes of a connection.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace isoatlas {

class ResponseReader {
public:
    ResponseReader();
    ~ResponseReader();

    /// The next bytes that have come. False: this is no answer of HTTP. Throws std::bad_alloc.
    [[nodiscard]] bool read(std::string_view bytes);
    /// All of it has come.
    [[nodiscard]] bool is_whole() const;
    [[nodiscard]] int status() const;
    [[nodiscard]] std::string type() const;
    [[nodiscard]] std::string& body();

private:
    struct Parser;
    std::unique_ptr<Parser> parser_;
    std::string rest_;  ///< not yet understood
};

}  // namespace isoatlas
