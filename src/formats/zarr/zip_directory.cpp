#include "formats/zarr/zip_directory.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include "formats/common/field_reader.h"
#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::uint32_t kEndSignature = 0x06054b50, kLocatorSignature = 0x07064b50, kEnd64Signature = 0x06064b50,
                        kEntrySignature = 0x02014b50, kLocalSignature = 0x04034b50;
constexpr std::int64_t kEndBytes = 22, kLocatorBytes = 20, kEnd64Bytes = 56, kEntryBytes = 46, kLocalBytes = 30, kLongestComment = 0xffff;

[[noreturn]] void damaged(const std::string& path, const std::string& where, const std::string& what) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = where,
                                   .what = what,
                                   .expected = "a complete zip archive",
                                   .next = "the archive is damaged or cut off: copy it again"});
}

std::vector<std::byte> bytes_at(File& file, const std::string& path, std::int64_t offset, std::int64_t count) {
    if (offset < 0 || count < 0 || offset > file.size() || count > file.size() - offset)
        damaged(path, "offset " + std::to_string(offset), "a part of the archive lies outside the file");
    std::vector<std::byte> bytes(static_cast<std::size_t>(count));
    read_fully(file, path, offset, bytes);
    return bytes;
}

std::int64_t checked_number(const std::string& path, std::uint64_t number) {
    if (number > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
        damaged(path, "list of entries", "a number does not fit in 63 bits");
    return static_cast<std::int64_t>(number);
}

/// Where the list of entries lies.
struct ZipList {
    std::int64_t offset = 0, bytes = 0, entries = 0;
};

/// The record at the end with 64-bit numbers, if there is one before the record at `end`.
std::optional<ZipList> long_list(File& file, const std::string& path, std::int64_t end) {
    if (end < kLocatorBytes) return std::nullopt;
    const std::vector<std::byte> locator = bytes_at(file, path, end - kLocatorBytes, kLocatorBytes);
    const FieldReader fields(locator, false);
    if (fields.at<std::uint32_t>(0) != kLocatorSignature) return std::nullopt;
    const std::vector<std::byte> record = bytes_at(file, path, checked_number(path, fields.at<std::uint64_t>(8)), kEnd64Bytes);
    const FieldReader numbers(record, false);
    if (numbers.at<std::uint32_t>(0) != kEnd64Signature) damaged(path, "end", "the record of a zip64 archive is missing");
    return ZipList{.offset = checked_number(path, numbers.at<std::uint64_t>(48)),
                   .bytes = checked_number(path, numbers.at<std::uint64_t>(40)),
                   .entries = checked_number(path, numbers.at<std::uint64_t>(32))};
}

ZipList find_list(File& file, const std::string& path) {
    const std::int64_t size = file.size(), begin = std::max<std::int64_t>(0, size - kEndBytes - kLongestComment);
    const std::vector<std::byte> tail = bytes_at(file, path, begin, size - begin);
    const FieldReader fields(tail, false);
    for (std::int64_t at = static_cast<std::int64_t>(tail.size()) - kEndBytes; at >= 0; --at) {
        const auto place = static_cast<std::size_t>(at);
        if (fields.at<std::uint32_t>(place) != kEndSignature) continue;
        if (begin + at + kEndBytes + fields.at<std::uint16_t>(place + 20) > size) continue;  // a signature inside the comment, or cut off
        if (const std::optional<ZipList> found = long_list(file, path, begin + at)) return *found;
        return {.offset = fields.at<std::uint32_t>(place + 16),
                .bytes = fields.at<std::uint32_t>(place + 12),
                .entries = fields.at<std::uint16_t>(place + 10)};
    }
    damaged(path, "end", "the list of its entries is missing");
}

/// Numbers that do not fit in 32 bits are in an extra field, those alone and in this order.
void take_long_numbers(const FieldReader& fields, std::size_t at, std::size_t end, std::array<std::uint64_t, 3>& numbers) {
    constexpr std::uint16_t kZip64 = 1;
    while (at + 4 <= end) {
        const auto id = fields.at<std::uint16_t>(at);
        const std::size_t begin = at + 4, next = begin + fields.at<std::uint16_t>(at + 2);
        if (next > end) return;
        std::size_t from = begin;
        for (std::uint64_t& number : numbers) {
            if (id != kZip64 || number != 0xffffffffU || from + 8 > next) continue;
            number = fields.at<std::uint64_t>(from);
            from += 8;
        }
        at = next;
    }
}

void check_entry(const std::string& path, const ZipEntry& entry, std::int64_t file_bytes) {
    constexpr std::int64_t kMostDeflated = 1032;  // a pair of 2 bits stands for at most 258 bytes
    const bool is_inside = entry.offset <= file_bytes - kLocalBytes && entry.packed <= file_bytes - kLocalBytes - entry.offset;
    const bool is_plausible = entry.method == kZipStored ? entry.bytes == entry.packed : entry.bytes / kMostDeflated <= entry.packed;
    if (!is_inside || !is_plausible) damaged(path, "list of entries", "an entry has sizes that no archive of this size can hold");
}

}  // namespace

std::vector<ZipEntry> read_zip_directory(File& file, const std::string& path) {
    const ZipList list = find_list(file, path);
    const std::vector<std::byte> bytes = bytes_at(file, path, list.offset, list.bytes);
    const FieldReader fields(bytes, false);
    std::vector<ZipEntry> entries;
    std::size_t at = 0;
    for (std::int64_t i = 0; i < list.entries; ++i) {
        if (at + kEntryBytes > bytes.size() || fields.at<std::uint32_t>(at) != kEntrySignature)
            damaged(path, "list of entries",
                    "the list ends after " + std::to_string(i) + " of " + std::to_string(list.entries) + " entries");
        const std::size_t name_bytes = fields.at<std::uint16_t>(at + 28), extra_bytes = fields.at<std::uint16_t>(at + 30),
                          name_at = at + kEntryBytes, extra_at = name_at + name_bytes,
                          next = extra_at + extra_bytes + fields.at<std::uint16_t>(at + 32);
        if (next > bytes.size()) damaged(path, "list of entries", "an entry of the list is cut off");
        std::array<std::uint64_t, 3> numbers{fields.at<std::uint32_t>(at + 24), fields.at<std::uint32_t>(at + 20),
                                             fields.at<std::uint32_t>(at + 42)};
        take_long_numbers(fields, extra_at, extra_at + extra_bytes, numbers);
        ZipEntry entry{.name = {reinterpret_cast<const char*>(bytes.data()) + name_at, name_bytes},
                       .offset = checked_number(path, numbers[2]),
                       .packed = checked_number(path, numbers[1]),
                       .bytes = checked_number(path, numbers[0]),
                       .crc = fields.at<std::uint32_t>(at + 16),
                       .method = fields.at<std::uint16_t>(at + 10),
                       .is_encrypted = (fields.at<std::uint16_t>(at + 8) & 1U) != 0};
        at = next;
        if (entry.name.empty() || entry.name.ends_with('/')) continue;
        check_entry(path, entry, file.size());
        entries.push_back(std::move(entry));
    }
    std::ranges::stable_sort(entries, {}, &ZipEntry::name);
    const auto is_replaced = [&](const ZipEntry& entry) { return &entry != &entries.back() && (&entry + 1)->name == entry.name; };
    std::vector<ZipEntry> last;
    last.reserve(entries.size());
    for (const ZipEntry& entry : entries) {
        if (!is_replaced(entry)) last.push_back(entry);
    }
    return last;
}

std::int64_t zip_data_offset(File& file, const std::string& path, const ZipEntry& entry) {
    const std::vector<std::byte> local = bytes_at(file, path, entry.offset, kLocalBytes);
    const FieldReader fields(local, false);
    const std::int64_t begin = entry.offset + kLocalBytes + fields.at<std::uint16_t>(26) + fields.at<std::uint16_t>(28);
    if (fields.at<std::uint32_t>(0) != kLocalSignature || begin > file.size() || entry.packed > file.size() - begin)
        damaged(path, "offset " + std::to_string(entry.offset), "an entry does not begin where the list says");
    return begin;
}

}  // namespace isoatlas
