// Callbacks of libtiff: it reads through base/file_system.h and its messages are collected.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <string>

#include "base/file_system.h"

namespace isoatlas {

/// File and messages of libtiff. No exception may pass through its frames.
struct TiffClient {
    std::string path;
    std::unique_ptr<File> file;
    std::int64_t position = 0;
    std::string messages;  ///< messages of libtiff since the last clear

    void say(const std::string& text);
};

/// Opens the file of a client, which must outlive the result. Null: libtiff cannot read it; see the messages.
/// Throws Error{resource} without memory.
[[nodiscard]] TIFF* open_tiff_client(TiffClient& client);

}  // namespace isoatlas
