// Deflate into a Sink: gzip files and gzip members, the same bytes for the same input on every run.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "isoatlas/sink.h"

namespace isoatlas {

class GzipStream {
public:
    explicit GzipStream(Sink& sink);
    ~GzipStream();
    void write(std::span<const std::byte> bytes);
    /// Writes the rest and the checksum; call once.
    void finish();

private:
    struct State;
    void run(int flush);

    Sink& sink_;
    std::unique_ptr<State> state_;
};

}  // namespace isoatlas
