// HDF5 lays the file out and says what its own structures are; all bytes are written here, through the one door to files.
#include "store/pack.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/atomic_file.h"
#include "base/check.h"
#include "store/checksum.h"
#include "store/container.h"
#include "store/hdf5_layout.h"

namespace isoatlas::store {
namespace {

static_assert(std::endian::native == std::endian::little, "stores are written as the memory is");

/// Writes an array as it comes and sums up its blocks.
class ArrayWriter {
public:
    ArrayWriter(AtomicFile& file, const StoredArray& array) : file_(file), array_(array) {}
    void put(std::span<const std::byte> bytes) {
        ISOATLAS_CHECK(written_ + static_cast<std::int64_t>(bytes.size()) <= array_.bytes());
        file_.write_at(array_.offset + written_, bytes);
        while (!bytes.empty()) {
            const std::int64_t room = array_.block == 0 ? array_.bytes() - written_ : array_.block - written_ % array_.block;
            const std::span<const std::byte> part = bytes.first(std::min<std::size_t>(bytes.size(), static_cast<std::size_t>(room)));
            XXH3_64bits_update(&state_, part.data(), part.size());
            written_ += static_cast<std::int64_t>(part.size());
            bytes = bytes.subspan(part.size());
            if (array_.block != 0 && (written_ % array_.block == 0 || written_ == array_.bytes())) finish_block();
        }
    }
    [[nodiscard]] const std::vector<std::uint64_t>& sums() const {
        ISOATLAS_CHECK(written_ == array_.bytes());
        return sums_;
    }

private:
    void finish_block() {
        sums_.push_back(XXH3_64bits_digest(&state_));
        XXH3_64bits_reset(&state_);
    }

    struct State : XXH3_state_t {
        State() { XXH3_64bits_reset(this); }
    };

    AtomicFile& file_;
    const StoredArray& array_;
    std::int64_t written_ = 0;
    State state_;
    std::vector<std::uint64_t> sums_;
};

void write_array(AtomicFile& file, const PackedArray& source, StoredArray& array) {
    ArrayWriter writer(file, array);
    source.feed([&](std::span<const std::byte> bytes) { writer.put(bytes); });
    const std::span<const std::byte> sums = std::as_bytes(std::span(writer.sums()));
    if (array.block == 0) return;
    file.write_at(array.checksums, sums);
    array.sum = checksum(sums);
}

}  // namespace

void pack_store(const std::string& path, Contents contents, const std::vector<PackedArray>& arrays) {
    AtomicFile file(path);
    Hdf5Layout layout(path);
    contents.arrays.clear();
    for (const PackedArray& source : arrays) {
        StoredArray array{source.name, source.type, source.shape, 0, source.block, 0, 0};
        array.offset = layout.add("/" + source.name, source.type, source.shape);
        if (array.blocks() > 0) array.checksums = layout.add("/checksums/" + source.name, "uint64", {array.blocks()});
        contents.arrays.push_back(std::move(array));
    }
    file.reserve(layout.size());
    for (std::size_t i = 0; i < arrays.size(); ++i) write_array(file, arrays[i], contents.arrays[i]);
    Header header;
    const std::string text = to_json(contents);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
    header.contents_bytes = static_cast<std::int64_t>(text.size());
    header.contents_offset = layout.add("/contents", "uint8", {header.contents_bytes});
    header.contents_checksum = checksum(bytes);
    file.write_at(header.contents_offset, bytes);
    for (const Hdf5Layout::Piece& piece : layout.finish()) file.write_at(piece.offset, piece.bytes);
    header.file_size = std::max(file.size(), layout.size());
    file.extend(header.file_size);
    file.write_at(0, bytes_of_header(header));
    file.commit();
}

}  // namespace isoatlas::store
