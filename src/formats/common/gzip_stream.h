// Deflate into an AtomicFile: gzip files and gzip members, the same bytes for the same input on every run.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "base/atomic_file.h"

namespace isoatlas {

class GzipStream {
public:
    explicit GzipStream(AtomicFile& file);
    ~GzipStream();
    void write(std::span<const std::byte> bytes);
    /// Writes the rest and the checksum; call once, before the file is committed.
    void finish();

private:
    struct State;
    void run(int flush);

    AtomicFile& file_;
    std::unique_ptr<State> state_;
};

}  // namespace isoatlas
