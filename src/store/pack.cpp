// HDF5 provides the layout and its own structures; all bytes are written here, through base/file_system.h.
#include "store/pack.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/atomic_file.h"
#include "base/check.h"
#include "base/parallel.h"
#include "codec/checksum.h"
#include "codec/chunk_codec.h"
#include "codec/frame.h"
#include "formats/common/hdf5_layout.h"
#include "store/container.h"

namespace isoatlas {
namespace {

static_assert(std::endian::native == std::endian::little, "stores are little endian");

/// Writes an array incrementally and computes the checksums of its blocks.
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

/// Compresses an array incrementally, several chunks in parallel, and writes them in order.
class ChunkWriter {
public:
    ChunkWriter(AtomicFile& file, Hdf5Layout& layout, const StoredArray& array) : file_(file), layout_(layout), array_(array) {}
    void put(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const std::size_t part = std::min(bytes.size(), kTogether * static_cast<std::size_t>(array_.block) - raw_.size());
            raw_.insert(raw_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(part));
            bytes = bytes.subspan(part);
            if (raw_.size() == kTogether * static_cast<std::size_t>(array_.block)) compress();
        }
    }
    void put_chunk(std::span<const std::byte> packed) {
        const std::int64_t offset = layout_.add_chunk(static_cast<std::int64_t>(packed.size()));
        file_.write_at(offset, packed);
        chunks_.push_back({static_cast<std::uint64_t>(offset), packed.size(), checksum(packed)});
    }
    [[nodiscard]] const std::vector<StoredChunk>& finish() {
        compress();
        ISOATLAS_CHECK(static_cast<std::int64_t>(chunks_.size()) == array_.blocks());
        return chunks_;
    }

private:
    static constexpr std::size_t kTogether = 16;

    void compress() {
        const auto block = static_cast<std::size_t>(array_.block), count = (raw_.size() + block - 1) / block;
        raw_.resize(count * block);  // the last chunk is padded
        std::vector<std::vector<std::byte>> packed(count);
        for_each_block(0, static_cast<std::int64_t>(count), [&](std::int64_t i) {
            packed[i] = encode_chunk(std::span(raw_).subspan(static_cast<std::size_t>(i) * block, block), size_of_type(array_.type));
        });
        for (const std::vector<std::byte>& chunk : packed) put_chunk(chunk);
        raw_.clear();
    }

    AtomicFile& file_;
    Hdf5Layout& layout_;
    const StoredArray& array_;
    std::vector<std::byte> raw_;
    std::vector<StoredChunk> chunks_;
};

/// Appends the locations of its chunks to `places`.
void write_chunks(AtomicFile& file, Hdf5Layout& layout, const PackedArray& source, StoredArray& array, std::vector<ByteRange>& places) {
    layout.begin_chunks("/" + source.name, source.type, {array.count()}, {source.chunk}, kDeflateLevel);
    ChunkWriter writer(file, layout, array);
    if (source.feed_chunks) {
        source.feed_chunks([&](std::span<const std::byte> packed) { writer.put_chunk(packed); });
    } else {
        source.feed([&](std::span<const std::byte> bytes) { writer.put(bytes); });
    }
    const std::vector<StoredChunk>& chunks = writer.finish();
    for (const StoredChunk& chunk : chunks) places.push_back({chunk.offset, chunk.bytes});
    const std::span<const std::byte> index = std::as_bytes(std::span(chunks));
    array.checksums = layout.add("/chunks/" + source.name, "uint64", {array.blocks(), 3});
    file.write_at(array.checksums, index);
    array.sum = checksum(index);
}

void write_array(AtomicFile& file, const PackedArray& source, StoredArray& array) {
    ArrayWriter writer(file, array);
    source.feed([&](std::span<const std::byte> bytes) { writer.put(bytes); });
    const std::span<const std::byte> sums = std::as_bytes(std::span(writer.sums()));
    if (array.block == 0) return;
    file.write_at(array.checksums, sums);
    array.sum = checksum(sums);
}

/// The frame of HDF5's layout: its pieces, and zeros in between.
StoreFrame frame_of(std::vector<ByteRange> ranges, const std::vector<Hdf5Layout::Piece>& pieces) {
    StoreFrame frame{std::move(ranges), 0};
    Checksum sum;
    std::vector<std::byte> bytes;
    for (const ByteRange& range : frame.ranges) {
        bytes.assign(static_cast<std::size_t>(range.bytes), std::byte{0});
        const auto begin = static_cast<std::int64_t>(range.offset), end = begin + static_cast<std::int64_t>(range.bytes);
        for (const Hdf5Layout::Piece& piece : pieces) {
            const std::int64_t first = std::max(begin, piece.offset);
            const std::int64_t last = std::min(end, piece.offset + static_cast<std::int64_t>(piece.bytes.size()));
            if (first < last) std::copy_n(piece.bytes.begin() + (first - piece.offset), last - first, bytes.begin() + (first - begin));
        }
        sum.add(bytes);
    }
    frame.checksum = sum.sum();
    return frame;
}

}  // namespace

std::int64_t pack_store(const std::string& path, Contents contents, const std::vector<PackedArray>& arrays) {
    AtomicFile file(path);
    Hdf5Layout layout(path, kHeaderBytes);
    contents.arrays.clear();
    for (const PackedArray& source : arrays) {
        StoredArray array{source.name, source.type, source.shape, 0, source.block, 0, 0, source.chunk};
        if (source.chunk > 0) {  // allocated when the size of its chunks is known
            contents.arrays.push_back(std::move(array));
            continue;
        }
        array.offset = layout.add("/" + source.name, source.type, source.shape);
        if (array.blocks() > 0) array.checksums = layout.add("/checksums/" + source.name, "uint64", {array.blocks()});
        contents.arrays.push_back(std::move(array));
    }
    file.reserve(layout.size());
    std::vector<ByteRange> covered;  // the chunks of arrays, then everything else with checksums of its own
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        if (arrays[i].chunk > 0) {
            write_chunks(file, layout, arrays[i], contents.arrays[i], covered);
        } else {
            write_array(file, arrays[i], contents.arrays[i]);
        }
    }
    Header header;
    const std::string text = to_json(contents);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
    header.contents_bytes = static_cast<std::int64_t>(text.size());
    header.contents_offset = layout.add("/contents", "uint8", {header.contents_bytes});
    header.contents_checksum = checksum(bytes);
    file.write_at(header.contents_offset, bytes);
    const std::vector<Hdf5Layout::Piece>& pieces = layout.finish();
    for (const Hdf5Layout::Piece& piece : pieces) file.write_at(piece.offset, piece.bytes);
    const std::int64_t end = std::max(file.size(), layout.size());
    file.extend(end);
    std::ranges::copy(checked_ranges(contents.arrays, header), std::back_inserter(covered));
    const StoreFrame frame = frame_of(outside(std::move(covered), static_cast<std::uint64_t>(end)), pieces);
    const std::vector<std::byte> trailer = bytes_of_trailer(frame);
    file.write_at(end, trailer);
    header.file_size = end + static_cast<std::int64_t>(trailer.size());
    file.write_at(0, bytes_of_header(header));
    file.commit();
    return header.file_size;
}

}  // namespace isoatlas
