// A file that a response sends.
#pragma once

#include <string>

#include "base/cancel.h"
#include "isoatlas/sink.h"

namespace isoatlas {

/// In memory; every write throws Error{cancelled} once the context is cancelled.
class Download final : public MemorySink {
public:
    /// format: the extension without its dot. The context must outlive the download.
    Download(const std::string& format, const Context& context) : MemorySink("file." + format), context_(context) {}
    using MemorySink::write;
    void write(std::span<const std::byte> bytes) override {
        stop_if_cancelled(context_);
        MemorySink::write(bytes);
    }
    void write_at(std::int64_t offset, std::span<const std::byte> bytes) override {
        stop_if_cancelled(context_);
        MemorySink::write_at(offset, bytes);
    }

private:
    const Context& context_;
};

}  // namespace isoatlas
