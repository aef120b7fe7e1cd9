// Multi-page TIFF in one pass, deflate: the strips of a page, then its directory, which links to the next one. Written without libtiff,
// which walks all earlier directories for every page it adds. Source: TIFF 6.0 specification, BigTIFF, ImageJ's TiffDecoder.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "formats/common/byte_writer.h"
#include "formats/common/volume_file.h"
#include "isoatlas/units.h"

namespace isoatlas {

namespace {

constexpr std::int64_t kBigTiffFrom = 3'900'000'000;  ///< raw bytes; offsets of plain TIFF end at 4 GiB
constexpr std::int64_t kStripBytes = std::int64_t{1} << 18;
constexpr int kLevel = 4;

enum class FieldType : std::uint16_t { ascii = 2, u16 = 3, u32 = 4, rational = 5, u64 = 16 };

std::size_t bytes_of_type(FieldType type) {
    switch (type) {
        case FieldType::ascii: return 1;
        case FieldType::u16: return 2;
        case FieldType::u32: return 4;
        default: return 8;
    }
}

/// Description for ImageJ. Without "images=": with it, ImageJ assumes uncompressed, contiguous pages.
std::string description_of(const VolumeInfo& info, const Geometry& geometry, const KeyValues& pairs) {
    std::string text = "ImageJ=1.53t\n";
    if (info.extent.rank == 3) text += "slices=" + std::to_string(info.extent.size[2]) + "\n";
    const std::string unit = ascii_unit(one_line(geometry.unit));
    text += "unit=" + (unit.empty() ? "pixel" : unit) + "\nspacing=" + number_text(geometry.spacing[2]) + "\nloop=false\n";
    if (!info.calibration.is_identity()) {
        text += "cf=0\nc0=" + number_text(info.calibration.intercept) + "\nc1=" + number_text(info.calibration.slope) + "\n";
        if (!info.value_unit.empty()) text += "vunit=" + one_line(info.value_unit) + "\n";
    }
    if (is_rectilinear(info.geometry)) text += "lost=rectilinear coordinates, replaced by their mean spacing\n";
    if (geometry.origin != Vec3{} || geometry.direction != Geometry{}.direction) text += "lost=origin and axis directions\n";
    for (const auto& [key, value] : pairs) text += key + "=" + value + "\n";
    return text;
}

/// Pixels per unit as a fraction of 32-bit numbers.
std::array<std::uint32_t, 2> resolution(double spacing) {
    const double pixels = 1 / spacing;
    if (!(pixels > 1e-9 && pixels < 4e9)) return {1, 1};
    const double denominator = std::min(1e6, std::floor(4e9 / std::max(pixels, 1.0)));
    if (pixels * denominator < 1e3) return {1'000'000'000, static_cast<std::uint32_t>(std::clamp(std::round(1e9 * spacing), 1.0, 4e9))};
    return {static_cast<std::uint32_t>(std::round(pixels * denominator)), static_cast<std::uint32_t>(denominator)};
}

/// One directory: entries in ascending order of tags, followed by long values.
class Directory {
public:
    Directory(bool big, std::int64_t offset) : big_(big), offset_(offset) {}

    template <class T>
    void add(std::uint16_t tag, FieldType type, const std::vector<T>& values) {
        const std::size_t bytes = values.size() * sizeof(T);
        entries_.push_back({tag, type, bytes / bytes_of_type(type), {reinterpret_cast<const char*>(values.data()), bytes}});
    }
    void add(std::uint16_t tag, std::uint16_t value) { add(tag, FieldType::u16, std::vector<std::uint16_t>{value}); }
    void add(std::uint16_t tag, std::uint32_t value) { add(tag, FieldType::u32, std::vector<std::uint32_t>{value}); }
    void add_text(std::uint16_t tag, const std::string& text) {
        add(tag, FieldType::ascii, std::vector<char>(text.c_str(), text.c_str() + text.size() + 1));
    }
    /// Positions are 8 bytes in BigTIFF, else 4.
    void add_positions(std::uint16_t tag, const std::vector<std::int64_t>& values) {
        if (big_) return add(tag, FieldType::u64, std::vector<std::uint64_t>(values.begin(), values.end()));
        std::vector<std::uint32_t> narrow(values.size());
        std::transform(values.begin(), values.end(), narrow.begin(), [](std::int64_t value) { return static_cast<std::uint32_t>(value); });
        add(tag, FieldType::u32, narrow);
    }
    [[nodiscard]] std::int64_t link_offset() const { return offset_ + size() - word(); }

    /// The bytes of the directory with a link of 0, followed by values that do not fit into it.
    [[nodiscard]] std::string bytes() const {
        std::string head, tail;
        if (big_)
            append(head, static_cast<std::uint64_t>(entries_.size()));
        else
            append(head, static_cast<std::uint16_t>(entries_.size()));
        for (const Entry& entry : entries_) {
            append(head, entry.tag);
            append(head, static_cast<std::uint16_t>(entry.type));
            append_word(head, static_cast<std::uint64_t>(entry.count));
            std::string value = entry.value;
            if (value.size() > static_cast<std::size_t>(word())) {
                append_word(head, static_cast<std::uint64_t>(offset_ + size()) + tail.size());
                value.resize((value.size() + 7) / 8 * 8);
                tail += value;
            } else {
                value.resize(static_cast<std::size_t>(word()));
                head += value;
            }
        }
        append_word(head, 0);
        return head + tail;
    }

private:
    struct Entry {
        std::uint16_t tag;
        FieldType type;
        std::size_t count;
        std::string value;  ///< bytes
    };
    [[nodiscard]] std::int64_t word() const { return big_ ? 8 : 4; }
    [[nodiscard]] std::int64_t size() const {
        return (big_ ? 8 + 20 * static_cast<std::int64_t>(entries_.size()) : 2 + 12 * static_cast<std::int64_t>(entries_.size())) + word();
    }
    template <class T>
    static void append(std::string& out, T value) {
        out.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void append_word(std::string& out, std::uint64_t value) const {
        if (big_)
            append(out, value);
        else
            append(out, static_cast<std::uint32_t>(value));
    }

    bool big_;
    std::int64_t offset_;
    std::vector<Entry> entries_;
};

class TiffWriter {
public:
    TiffWriter(Sink& sink, const VolumeInfo& info, const KeyValues& pairs)
        : sink_(sink), info_(info), geometry_(regular_geometry(info)), description_(description_of(info, geometry_, pairs)) {
        const std::int64_t row = info.extent.size[0] * static_cast<std::int64_t>(size_of(info.type));
        big_ = info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type)) > kBigTiffFrom;
        rows_ = std::clamp<std::int64_t>(kStripBytes / row, 1, info.extent.size[1]);
        row_bytes_ = row;
        strip_.reserve(static_cast<std::size_t>(rows_ * row));
        write_header();
    }

    /// Collects samples to strips and strips to pages.
    void put(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const std::int64_t rows = std::min(rows_, info_.extent.size[1] - row_);
            const auto missing = static_cast<std::size_t>(rows * row_bytes_) - strip_.size();
            const std::size_t count = std::min(missing, bytes.size());
            strip_.insert(strip_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
            bytes = bytes.subspan(count);
            if (count == missing) finish_strip(rows);
        }
    }

private:
    void write_header() {
        const bool big_endian = std::endian::native == std::endian::big;
        sink_.write(std::string_view(big_endian ? "MM" : "II"));
        link_ = big_ ? 8 : 4;
        if (big_) {
            const std::array<std::uint16_t, 7> rest{43, 8, 0, 0, 0, 0, 0};
            sink_.write(std::as_bytes(std::span(rest)));
        } else {
            const std::array<std::uint16_t, 3> rest{42, 0, 0};
            sink_.write(std::as_bytes(std::span(rest)));
        }
    }
    void finish_strip(std::int64_t rows) {
        uLongf size = compressBound(strip_.size());
        packed_.resize(size);
        const int result = compress2(reinterpret_cast<Bytef*>(packed_.data()), &size, reinterpret_cast<const Bytef*>(strip_.data()),
                                     strip_.size(), kLevel);
        if (result != Z_OK) throw Error(ErrorKind::resource, {.file = sink_.name(), .what = "not enough memory to compress"});
        offsets_.push_back(sink_.size());
        counts_.push_back(static_cast<std::int64_t>(size));
        sink_.write(std::span<const std::byte>(packed_).first(size));
        strip_.clear();
        row_ += rows;
        if (row_ == info_.extent.size[1]) finish_page();
    }
    void finish_page() {
        const std::array<std::byte, 8> zeros{};
        sink_.write(std::span(zeros).first(static_cast<std::size_t>((8 - sink_.size() % 8) % 8)));
        const std::int64_t offset = sink_.size();
        const Directory directory = describe_page(offset);
        sink_.write(directory.bytes());
        set_link(offset);
        link_ = directory.link_offset();
        first_ = false;
        offsets_.clear();
        counts_.clear();
        row_ = 0;
    }
    Directory describe_page(std::int64_t offset) const {
        Directory directory(big_, offset);
        const ValueType type = info_.type;
        const std::uint16_t format = is_floating(type)                                                           ? 3
                                     : type == ValueType::i8 || type == ValueType::i16 || type == ValueType::i32 ? 2
                                                                                                                 : 1;
        directory.add(256, static_cast<std::uint32_t>(info_.extent.size[0]));
        directory.add(257, static_cast<std::uint32_t>(info_.extent.size[1]));
        directory.add(258, static_cast<std::uint16_t>(8 * size_of(type)));
        directory.add(259, std::uint16_t{8});  // deflate
        directory.add(262, std::uint16_t{1});  // 0 is black
        if (first_) directory.add_text(270, description_);
        directory.add_positions(273, offsets_);
        directory.add(277, std::uint16_t{1});
        directory.add(278, static_cast<std::uint32_t>(rows_));
        directory.add_positions(279, counts_);
        const std::array<std::uint32_t, 2> x = resolution(geometry_.spacing[0]), y = resolution(geometry_.spacing[1]);
        directory.add(282, FieldType::rational, std::vector<std::uint32_t>(x.begin(), x.end()));
        directory.add(283, FieldType::rational, std::vector<std::uint32_t>(y.begin(), y.end()));
        directory.add(296, std::uint16_t{1});  // the unit is in the description
        directory.add(339, format);
        return directory;
    }
    void set_link(std::int64_t offset) {
        const auto wide = static_cast<std::uint64_t>(offset);
        const auto narrow = static_cast<std::uint32_t>(offset);
        if (big_)
            sink_.write_at(link_, std::as_bytes(std::span(&wide, 1)));
        else
            sink_.write_at(link_, std::as_bytes(std::span(&narrow, 1)));
    }

    Sink& sink_;
    const VolumeInfo& info_;
    Geometry geometry_;
    std::string description_;
    bool big_ = false, first_ = true;
    std::int64_t rows_ = 1, row_bytes_ = 0;  ///< of a strip; of a row
    std::int64_t row_ = 0;                   ///< rows of this page that are written
    std::int64_t link_ = 0;                  ///< where the offset of the next directory goes
    std::vector<std::byte> strip_, packed_;
    std::vector<std::int64_t> offsets_, counts_;
};

}  // namespace

void write_tiff(Sink& sink, const VolumeInfo& info, const SampleFeed& samples, const KeyValues& pairs) {
    if (std::max(info.extent.size[0], info.extent.size[1]) > std::int64_t{0xffffffff}) {
        throw Error(ErrorKind::usage, {.file = sink.name(),
                                       .what = "an axis has more than 2^32 samples, which TIFF cannot represent",
                                       .next = "choose another format, e.g. .nrrd"});
    }
    TiffWriter writer(sink, info, pairs);
    samples([&](std::span<const std::byte> bytes) { writer.put(bytes); });
}

}  // namespace isoatlas
