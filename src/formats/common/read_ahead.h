// A file that is read in many small pieces near each other, as the directories of TIFF are.
#pragma once

#include <memory>

#include "base/file_system.h"

namespace isoatlas {

/// The same bytes as those of a file, for reading: small pieces come out of blocks of 4 KiB that were read before, of which it keeps the
/// last two. What a block cannot be read for is read alone.
[[nodiscard]] std::unique_ptr<File> with_read_ahead(std::unique_ptr<File> file);

}  // namespace isoatlas
