// The files of libtiff: it reads through base/file_system.h and says what it has to say to us.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <string>

#include "base/file_system.h"

namespace isoatlas {

/// What libtiff reads from and talks to. No exception may pass through its frames.
struct TiffClient {
    std::string path;
    std::unique_ptr<File> file;
    std::int64_t position = 0;
    std::string messages;  ///< what libtiff said since the last clear

    void say(const std::string& text);
};

/// Opens the file of a client, which must outlive what is returned. Null: libtiff cannot read it; the messages say why.
/// Throws Error{resource} without memory.
[[nodiscard]] TIFF* open_tiff_client(TiffClient& client);

}  // namespace isoatlas
