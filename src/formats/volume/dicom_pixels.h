// The pictures of a DICOM file: how samples are stored, and one frame of them at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/volume/dicom_header.h"
#include "formats/volume/dicom_input.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct DicomPixels {
    std::int64_t rows = 0, columns = 0, frames = 1;
    int allocated = 16, stored = 16, high_bit = 15;  ///< bits
    bool is_signed = false;
    ValueType type = ValueType::u16;

    [[nodiscard]] std::int64_t frame_bytes() const { return rows * columns * static_cast<std::int64_t>(size_of(type)); }
    [[nodiscard]] bool same_shape(const DicomPixels& other) const {
        return rows == other.rows && columns == other.columns && type == other.type;
    }
};

/// Checks that the file can hold what it claims. Throws Error: input (damaged, truncated), unsupported (colour, 1, 12 or 64 bits, a
/// transfer syntax that is not decoded).
[[nodiscard]] DicomPixels dicom_pixels(const DicomHeader& header);

/// Reads frames of one file, which stays open. Throws Error{input}.
class DicomFrames {
public:
    DicomFrames(DicomHeader header, const DicomPixels& pixels);
    /// Samples of pixels.type in host byte order; out.size() == frame_bytes(). Memory: the frame as it is stored.
    void read(std::int64_t frame, std::span<std::byte> out);
    [[nodiscard]] const std::string& path() const { return header_.path; }

private:
    struct Fragment {
        std::int64_t begin = 0, bytes = 0;
    };
    void read_native(std::int64_t frame, std::span<std::byte> out);
    void read_encapsulated(std::int64_t frame, std::span<std::byte> out);
    void list_fragments();
    [[nodiscard]] std::span<const Fragment> fragments_of(std::int64_t frame) const;
    [[noreturn]] void damaged(const std::string& what, const std::string& expected) const;

    DicomHeader header_;
    DicomPixels pixels_;
    std::unique_ptr<DicomInput> input_;
    std::vector<std::int64_t> offsets_;  ///< of frames, from the first fragment on
    std::vector<Fragment> fragments_;
    bool is_listed_ = false;
};

}  // namespace isoatlas
