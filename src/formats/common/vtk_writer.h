// VTK XML files with raw appended data (header_type UInt64, little endian): the elements first, then one block of bytes per array.
// Source: VTK file formats, docs.vtk.org.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/common/byte_writer.h"
#include "formats/common/generator.h"

namespace isoatlas {

template <class T>
inline constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
inline constexpr const char* vtk_type<float> = "Float32";
template <>
inline constexpr const char* vtk_type<double> = "Float64";

/// The tag before raw blocks, and white space that fills a whole block of 4096 bytes of the file. VTK before 9.3.1
/// reads files in such blocks; with an expat that defers its work (2.6, and 2.5 in Debian since 2024) it notices the end of the tag only
/// in the block after it, and took raw bytes there for broken XML. VTK issue 19258.
inline void begin_appended_data(ByteWriter& out) {
    constexpr std::int64_t kBlock = 4096;
    constexpr std::string_view kTag = "<AppendedData encoding=\"raw\">\n";
    const std::int64_t end = out.size() + static_cast<std::int64_t>(kTag.size());
    const std::int64_t white_end = (end + kBlock - 1) / kBlock * kBlock + kBlock;
    out.text(std::string(kTag) + std::string(static_cast<std::size_t>(white_end - end), ' ') + "_");
}

/// The appended blocks. add() returns the element that refers to the block; write() must follow all elements.
class AppendedArrays {
public:
    /// put writes exactly tuples * components values of T.
    template <class T>
    [[nodiscard]] std::string add(std::string_view name, std::int64_t components, std::int64_t tuples, std::function<void(ByteWriter&)> put,
                                  bool field = false) {
        std::string element = "<DataArray type=\"" + std::string(vtk_type<T>) + "\" Name=\"" + std::string(name) + "\" ";
        if (components > 1) element += "NumberOfComponents=\"" + std::to_string(components) + "\" ";
        if (field) element += "NumberOfTuples=\"" + std::to_string(tuples) + "\" ";  // other arrays have the length of their piece
        element += "format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
        const std::int64_t bytes = components * tuples * static_cast<std::int64_t>(sizeof(T));
        blocks_.push_back({bytes, std::move(put)});
        offset_ += 8 + bytes;
        return element;
    }
    void write(ByteWriter& out) const {
        begin_appended_data(out);
        for (const Block& block : blocks_) {
            out.put(static_cast<std::uint64_t>(block.bytes));
            block.put(out);
        }
        out.text("\n</AppendedData>\n");
    }

private:
    struct Block {
        std::int64_t bytes;
        std::function<void(ByteWriter&)> put;
    };
    std::vector<Block> blocks_;
    std::int64_t offset_ = 0;
};

[[nodiscard]] inline std::string vtk_file_begin(const char* type) {
    return "<?xml version=\"1.0\"?>\n<!-- " + std::string(kGenerator) + " -->\n<VTKFile type=\"" + type +
           "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

/// Texts as VTK stores them in field data: their bytes as numbers, each ended by 0. Any character is safe in the XML.
[[nodiscard]] inline std::string vtk_strings(std::string_view name, std::span<const std::string> texts) {
    std::string element = "<DataArray type=\"String\" Name=\"" + std::string(name) + "\" NumberOfTuples=\"" + std::to_string(texts.size()) +
                          "\" format=\"ascii\">";
    for (std::size_t i = 0; i < texts.size(); ++i) {
        for (const char c : decoded_text(texts[i])) element += std::to_string(static_cast<int>(static_cast<unsigned char>(c))) + " ";
        element += i + 1 < texts.size() ? "0 " : "0";
    }
    return element + "</DataArray>\n";
}
[[nodiscard]] inline std::string vtk_string(std::string_view name, std::string_view text) {
    const std::string only(text);
    return vtk_strings(name, std::span(&only, 1));
}

}  // namespace isoatlas
