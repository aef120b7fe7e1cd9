// A zlib stream of known length, decompressed on reading in constant memory.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/common/byte_source.h"

namespace isoatlas {

class BlockInflater {
public:
    BlockInflater();
    ~BlockInflater();
    BlockInflater(const BlockInflater&) = delete;
    BlockInflater& operator=(const BlockInflater&) = delete;

    /// The stream is the next `compressed` bytes of the source and decompresses to `bytes`.
    void start(std::int64_t compressed, std::int64_t bytes);
    /// Reads the next bytes, at most the remaining ones. Reading the last one reads the stream to its end, its checksum included. Returns a
    /// description of the error in the stream, "" for none. Throws what the source throws.
    [[nodiscard]] std::string read(ByteSource& source, std::span<std::byte> out);
    /// Number of bytes read so far.
    [[nodiscard]] std::int64_t position() const { return position_; }

private:
    [[nodiscard]] std::string finish(ByteSource& source);
    [[nodiscard]] int inflate_some(ByteSource& source, std::span<std::byte> out, std::size_t& count);

    z_stream stream_{};
    std::vector<std::byte> buffer_;
    std::int64_t unread_ = 0;  // remaining compressed bytes of the source
    std::int64_t bytes_ = 0, position_ = 0;
};

}  // namespace isoatlas
