// The bytes of a DICOM file, read forwards: as they are, or those that a raw deflate stream holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace isoatlas {

class DicomInput {
public:
    virtual ~DicomInput() = default;
    [[nodiscard]] virtual std::int64_t position() const = 0;
    /// Fills all of out and advances; the number of bytes that were there. Throws Error{input} when the disk fails or the stream is
    /// corrupt.
    [[nodiscard]] virtual std::size_t read(std::span<std::byte> out) = 0;
    /// Moves to a position, also behind the end. Cost: O(1), deflated O(distance), backwards O(position).
    virtual void seek(std::int64_t position) = 0;
    /// At most so many bytes follow any position; known without decoding.
    [[nodiscard]] virtual std::int64_t size_bound() const = 0;
    [[nodiscard]] virtual bool is_deflated() const = 0;
};

/// Throws Error{input} as open_file().
[[nodiscard]] std::unique_ptr<DicomInput> open_dicom_input(const std::string& path);
/// The bytes that the raw deflate stream from `offset` to the end of the file decompresses to; position 0 is the first.
[[nodiscard]] std::unique_ptr<DicomInput> open_deflated_dicom_input(const std::string& path, std::int64_t offset);

}  // namespace isoatlas
