#include "formats/volume/hdf5_frame.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace isoatlas {
namespace {

constexpr std::size_t kCollectionSizeAt = 8;

bool fill(File& file, std::uint64_t offset, std::span<std::byte> out) {
    for (std::size_t done = 0; done < out.size();) {
        const std::ptrdiff_t got = file.read_at(static_cast<std::int64_t>(offset + done), out.subspan(done));
        if (got <= 0) return false;
        done += static_cast<std::size_t>(got);
    }
    return true;
}

/// What follows the version and the counts of a superblock: addresses, among them that of the header of the first group.
bool read_addresses(Hdf5Frame& frame, std::uint64_t version) {
    const std::size_t first = version == 0 ? 24 : version == 1 ? 28 : 12, size = frame.address_bytes;
    std::vector<std::byte> bytes(first + 5 * size + frame.length_bytes);
    if (!frame.read(0, bytes)) return false;
    frame.root = hdf5_number(bytes, first + (version < 2 ? 4 * size + frame.length_bytes : 3 * size), size);
    const std::uint64_t none = ~std::uint64_t{0} >> (64 - 8 * size), extension = hdf5_number(bytes, first + size, size);
    if (version >= 2 && extension != none) frame.extension = extension;
    return true;
}

}  // namespace

std::uint64_t Hdf5Frame::rest(std::uint64_t address) const {
    const auto all = static_cast<std::uint64_t>(file->size());
    return base > all || address > all - base ? 0 : all - base - address;
}

bool Hdf5Frame::read(std::uint64_t address, std::span<std::byte> out) const {
    return rest(address) >= out.size() && fill(*file, base + address, out);
}

std::optional<Hdf5Frame> hdf5_frame_of(File& file) {
    constexpr std::array<unsigned char, 8> kSignature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    std::array<std::byte, 28> bytes{};
    const auto all = static_cast<std::uint64_t>(file.size());
    for (std::uint64_t at = 0; at <= all && all - at >= bytes.size(); at = at == 0 ? 512 : 2 * at) {
        if (!fill(file, at, bytes)) return std::nullopt;
        if (std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) != 0) continue;
        const std::uint64_t version = hdf5_number(bytes, 8, 1);
        const std::size_t sizes = version < 2 ? 13 : 9;
        Hdf5Frame frame{.file = &file,
                        .base = at,
                        .address_bytes = static_cast<std::size_t>(hdf5_number(bytes, sizes, 1)),
                        .length_bytes = static_cast<std::size_t>(hdf5_number(bytes, sizes + 1, 1))};
        const auto is_known = [](std::size_t count) { return count == 2 || count == 4 || count == 8; };
        if (!is_known(frame.address_bytes) || !is_known(frame.length_bytes)) return std::nullopt;
        if (!read_addresses(frame, version)) return std::nullopt;
        return frame;
    }
    return std::nullopt;
}

std::uint64_t hdf5_number(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(bytes[at + i]);
    return value;
}

std::vector<std::byte> read_hdf5_collection(const Hdf5Frame& frame, std::uint64_t address) {
    constexpr std::size_t kMaxHeapBytes = std::size_t{64} << 20;
    std::vector<std::byte> bytes(kCollectionSizeAt + frame.length_bytes);
    if (!frame.read(address, bytes) || std::memcmp(bytes.data(), "GCOL\1", 5) != 0) return {};
    const std::uint64_t size = hdf5_number(bytes, kCollectionSizeAt, frame.length_bytes);
    if (size < bytes.size() || size > frame.rest(address) || size > kMaxHeapBytes) return {};
    bytes.resize(static_cast<std::size_t>(size));
    return frame.read(address, bytes) ? bytes : std::vector<std::byte>{};
}

// Of an object: number, references, reserved bytes, size.
std::span<const std::byte> hdf5_object(const Hdf5Frame& frame, std::span<const std::byte> collection, std::uint64_t number) {
    const std::size_t header = kCollectionSizeAt + frame.length_bytes;
    for (std::size_t at = header; at + header <= collection.size();) {
        const std::uint64_t found = hdf5_number(collection, at, 2), size = hdf5_number(collection, at + 8, frame.length_bytes);
        at += header;
        if (found == 0 || size > collection.size() - at) break;  // 0: free to the end
        if (found == number) return collection.subspan(at, static_cast<std::size_t>(size));
        at += std::min(collection.size() - at, static_cast<std::size_t>((size + 7) / 8 * 8));
    }
    return {};
}

bool is_sound_hdf5_collection(const Hdf5Frame& frame, std::span<const std::byte> collection) {
    constexpr std::uint64_t kMinBytes = 4096;  // HDF5 reads as many before it knows the size
    const std::size_t header = kCollectionSizeAt + frame.length_bytes;
    if (collection.size() < kMinBytes) return false;
    for (std::size_t at = header; at + header <= collection.size();) {
        const std::uint64_t number = hdf5_number(collection, at, 2), size = hdf5_number(collection, at + 8, frame.length_bytes),
                            rest = collection.size() - at;
        if (size > rest) return false;
        const std::uint64_t whole = number == 0 ? size : header + (size + 7) / 8 * 8;  // that of free bytes counts its header
        if (whole < header || whole > rest) return false;
        at += static_cast<std::size_t>(whole);
    }
    return true;
}

}  // namespace isoatlas
