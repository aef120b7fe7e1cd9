#include "store/container.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "base/parallel.h"
#include "codec/checksum.h"
#include "codec/chunk_codec.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxContents = std::int64_t{1} << 28;  // a header that claims more is damaged

struct RawHeader {
    char magic[16];
    std::uint64_t file_size, contents_offset, contents_bytes, contents_checksum, checksum;
};
static_assert(sizeof(RawHeader) == 56);
constexpr std::size_t kCheckedHeader = 48;
constexpr std::uint64_t kReadAtOnce = std::uint64_t{1} << 18;
constexpr std::int64_t kLastBytes = 64 << 10;  ///< mostly with the trailer, the contents, and what lies before them

/// Of a damaged table: empty, where it lies outside of any file.
FileRange range_of(const StoredChunk& chunk) {
    constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (chunk.offset > kMax || chunk.bytes > kMax - chunk.offset) return {};
    return {static_cast<std::int64_t>(chunk.offset), static_cast<std::int64_t>(chunk.offset + chunk.bytes)};
}

}  // namespace

std::array<std::byte, kHeaderBytes> bytes_of_header(const Header& header) {
    RawHeader raw{};
    std::memcpy(raw.magic, kMagic, sizeof kMagic);
    raw.file_size = static_cast<std::uint64_t>(header.file_size);
    raw.contents_offset = static_cast<std::uint64_t>(header.contents_offset);
    raw.contents_bytes = static_cast<std::uint64_t>(header.contents_bytes);
    raw.contents_checksum = header.contents_checksum;
    std::array<std::byte, kHeaderBytes> bytes{};
    std::memcpy(bytes.data(), &raw, sizeof raw);
    raw.checksum = checksum(std::span(bytes).first(kCheckedHeader));
    std::memcpy(bytes.data(), &raw, sizeof raw);
    return bytes;
}

std::vector<ByteRange> checked_ranges(const std::vector<StoredArray>& arrays, const Header& header) {
    std::vector<ByteRange> ranges;
    const auto add = [&ranges](std::int64_t offset, std::int64_t bytes) {
        ranges.push_back({static_cast<std::uint64_t>(offset), static_cast<std::uint64_t>(bytes)});
    };
    add(0, kHeaderBytes);
    add(header.contents_offset, header.contents_bytes);
    for (const StoredArray& array : arrays) {
        add(array.checksums, array.index_bytes());
        if (array.chunk == 0) add(array.offset, array.bytes());
    }
    return ranges;
}

bool begins_like_a_store(std::span<const std::byte> first) {
    constexpr int kEnough = 12;  // of the 16 bytes of the name
    constexpr char kHdf5[] = "\x89HDF\r\n\x1a\n";
    constexpr std::ptrdiff_t kFew = 8;
    if (first.size() >= kBeginning &&
        std::memcmp(first.data() + kHeaderBytes, kHdf5, 8) == 0) {  // files of other programs have user blocks too
        const std::span<const std::byte> zeros = first.first(kHeaderBytes).subspan(sizeof(RawHeader));
        if (std::ranges::count(zeros, std::byte{0}) >= std::ssize(zeros) - kFew) return true;
    }
    int same = 0;
    for (std::size_t i = 0; i < std::min(first.size(), sizeof kMagic); ++i) same += first[i] == static_cast<std::byte>(kMagic[i]) ? 1 : 0;
    return same >= kEnough;
}

Container::Container(const std::string& path, const Corrections& corrections)
    : path_(path), file_(open_file(path)), file_size_(file_->size()) {
    read_header();
    all_arrays_ = contents_.arrays;
    if (corrections.is_empty()) return;
    const Geometry before = contents_.volume.geometry;
    correct(contents_.volume, corrections);
    const Geometry& now = contents_.volume.geometry;
    has_other_steps_ = now.spacing != before.spacing || now.coordinates != before.coordinates;
    if (has_other_steps_ && contents_.volume.gaussian > 0) {
        throw Error(ErrorKind::usage, {.file = path_,
                                       .what = "the spacing decides how the samples of this store were filtered",
                                       .expected = "the spacing of the store",
                                       .next = "omit the spacing, or build another store from the volume"});
    }
}

Container::Container(const std::string& path, std::optional<Polarity> polarity, const Corrections& corrections)
    : Container(path, corrections) {
    const Polarity own = contents_.polarities == PolarityChoice::low ? Polarity::low : Polarity::high;
    contents_ = contents_of(contents_, polarity.value_or(own));
}

void Container::prefetch(const StoredArray& array, std::vector<FileRange> ranges) const {
    for (FileRange& range : ranges) range.begin += array.offset, range.end += array.offset;
    if (!ranges.empty()) file_->prefetch_ranges(ranges);
}

void Container::fetch(std::span<const StoredArray* const> arrays) const {
    std::vector<FileRange> ranges;
    for (const StoredArray* array : arrays) {
        ranges.push_back({array->checksums, array->checksums + array->index_bytes()});
        if (array->chunk == 0) ranges.push_back({array->offset, array->offset + array->bytes()});
    }
    fetch(std::move(ranges));
    ranges.clear();
    for (const StoredArray* array : arrays) {
        if (array->chunk == 0) continue;
        for (const StoredChunk& chunk : chunk_table(*array, 0, array->blocks())) ranges.push_back(range_of(chunk));
    }
    fetch(std::move(ranges));
}

void Container::fetch(const StoredArray& array, std::span<const FileRange> bytes) const {
    if (array.chunk == 0 || bytes.empty()) return;
    const std::int64_t first = bytes.front().begin / array.block, last = (bytes.back().end + array.block - 1) / array.block;
    const std::vector<StoredChunk> chunks = chunk_table(array, first, last);
    std::vector<FileRange> ranges;
    for (const FileRange& range : bytes) {
        for (std::int64_t i = range.begin / array.block; i * array.block < range.end; ++i)
            ranges.push_back(range_of(chunks[static_cast<std::size_t>(i - first)]));
    }
    fetch(std::move(ranges));
}

void Container::fetch_groups(std::span<const std::string_view> groups) const {
    std::vector<const StoredArray*> arrays;
    for (const StoredArray& array : contents_.arrays) {
        const std::string_view group = std::string_view(array.name).substr(0, array.name.find('/'));
        if (std::ranges::find(groups, group) != groups.end()) arrays.push_back(&array);
    }
    fetch(arrays);
}

/// Ranges in any order, which may overlap or be empty.
void Container::fetch(std::vector<FileRange> ranges) const {
    std::ranges::sort(ranges, {}, &FileRange::begin);
    std::vector<FileRange> apart;
    for (FileRange range : ranges) {
        range = {std::max<std::int64_t>(range.begin, 0), std::min(range.end, file_size_)};
        if (range.bytes() <= 0) continue;
        if (!apart.empty() && range.begin <= apart.back().end)
            apart.back().end = std::max(apart.back().end, range.end);
        else
            apart.push_back(range);
    }
    if (!apart.empty()) file_->fetch_ranges(apart);
}

void Container::damaged(const std::string& where, const std::string& what) const {
    throw Error(ErrorKind::input,
                {.file = path_, .where = where, .what = what, .next = "the store is damaged: build it again from the volume"});
}

void Container::read_header() {
    std::array<std::byte, kBeginning> beginning{};
    const std::size_t got = read_available(*file_, path_, 0, beginning);
    const std::span<const std::byte> bytes = std::span(beginning).first(kHeaderBytes);
    if (!begins_like_a_store(std::span(beginning).first(got))) {
        throw Error(ErrorKind::input, {.file = path_,
                                       .what = "is not an isoatlas store",
                                       .expected = "a file that a build has written",
                                       .next = "build one from the volume",
                                       .reason = Reason::not_a_store});
    }
    RawHeader raw;
    std::memcpy(&raw, bytes.data(), sizeof raw);
    const bool rest_is_zero = std::all_of(bytes.begin() + sizeof raw, bytes.end(), [](std::byte b) { return b == std::byte{0}; });
    if (std::memcmp(raw.magic, kMagic, sizeof kMagic) != 0) damaged("header", "its first bytes are wrong");
    if (got < bytes.size() || raw.checksum != checksum(std::span(bytes).first(kCheckedHeader)) || !rest_is_zero)
        damaged("header", "its checksum is wrong");
    if (raw.file_size != static_cast<std::uint64_t>(file_size_)) {
        damaged("header", "the file has " + std::to_string(file_size_) + " bytes and should have " + std::to_string(raw.file_size));
    }
    const auto offset = static_cast<std::int64_t>(raw.contents_offset), size = static_cast<std::int64_t>(raw.contents_bytes);
    if (size < 0 || size > kMaxContents || offset < kHeaderBytes || offset > file_size_ - size)
        damaged("header", "the contents lie outside the file");
    header_ = {file_size_, offset, size, raw.contents_checksum};
    const bool has_frame = check_frame();
    contents_ = contents_of_json(contents_text(), path_, file_size_);
    if (contents_.version >= 3 && !has_frame) damaged("trailer", "its last bytes are wrong");
    contents_.volume.path = path_;
    contents_.volume.file_bytes = file_size_;
}

bool Container::check_frame() {
    fetch({{file_size_ - kLastBytes, file_size_}});
    std::vector<std::byte> bytes(static_cast<std::size_t>(kTrailerEnd));
    read_fully(*file_, path_, file_size_ - kTrailerEnd, bytes);
    const std::optional<std::int64_t> size = trailer_bytes(bytes, file_size_);
    if (!size) return false;
    bytes.resize(static_cast<std::size_t>(*size));
    read_fully(*file_, path_, file_size_ - *size, bytes);
    std::optional<StoreFrame> frame = frame_of_trailer(bytes, file_size_);
    if (!frame) damaged("trailer", "its checksum is wrong");
    std::vector<FileRange> ranges;
    for (const ByteRange& range : frame->ranges)
        ranges.push_back({static_cast<std::int64_t>(range.offset), static_cast<std::int64_t>(range.offset + range.bytes)});
    fetch(std::move(ranges));
    Checksum sum;
    for (const ByteRange& range : frame->ranges) {
        for (std::uint64_t done = 0; done < range.bytes; done += bytes.size()) {
            bytes.resize(static_cast<std::size_t>(std::min(range.bytes - done, kReadAtOnce)));
            read_fully(*file_, path_, static_cast<std::int64_t>(range.offset + done), bytes);
            sum.add(bytes);
        }
    }
    if (sum.sum() != frame->checksum) damaged("structures of HDF5", "their checksum is wrong");
    frame_ = std::move(*frame);
    return true;
}

void Container::check_nothing_is_left_out() const {
    std::vector<ByteRange> covered = checked_ranges(all_arrays_, header_);
    std::ranges::copy(frame_.ranges, std::back_inserter(covered));
    const std::uint64_t trailer = bytes_of_trailer(frame_).size();
    covered.push_back({static_cast<std::uint64_t>(file_size_) - trailer, trailer});
    for (const StoredArray& array : all_arrays_) {
        if (array.chunk == 0) continue;
        for (const StoredChunk& chunk : chunks_of(array, 0, array.blocks())) covered.push_back({chunk.offset, chunk.bytes});
    }
    const std::vector<ByteRange> left = outside(std::move(covered), static_cast<std::uint64_t>(file_size_));
    if (!left.empty()) damaged("byte " + std::to_string(left.front().offset), "no checksum covers it");
}

std::vector<std::uint64_t> Container::checksums_of(const StoredArray& array, std::int64_t first, std::int64_t last) const {
    std::vector<std::uint64_t> sums(static_cast<std::size_t>(last - first));
    read_fully(*file_, path_, array.checksums + 8 * first, std::as_writable_bytes(std::span(sums)));
    return sums;
}

std::string Container::contents_text() const {
    std::string text(static_cast<std::size_t>(header_.contents_bytes), '\0');
    read_fully(*file_, path_, header_.contents_offset, std::as_writable_bytes(std::span<char>(text)));
    if (checksum(std::as_bytes(std::span<const char>(text))) != header_.contents_checksum) damaged("contents", "their checksum is wrong");
    return text;
}

std::vector<std::uint64_t> Container::index_of(const StoredArray& array) const {
    std::vector<std::uint64_t> index(static_cast<std::size_t>(array.index_bytes() / 8));
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(index));
    read_fully(*file_, path_, array.checksums, bytes);
    if (checksum(bytes) != array.sum) damaged(array.name, "the checksum of its checksums is wrong");
    return index;
}

void Container::read(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const {
    const auto size = static_cast<std::int64_t>(out.size());
    if (first < 0 || first > array.bytes() - size || array.block == 0) damaged(array.name, "requested bytes are outside the array");
    if (size == 0) return;
    if (array.chunk > 0) return read_chunks(array, first, out);
    const std::int64_t begin = first / array.block, end = (first + size + array.block - 1) / array.block;
    fetch({{array.checksums + 8 * begin, array.checksums + 8 * end},
           {array.offset + begin * array.block, array.offset + std::min(end * array.block, array.bytes())}});
    const std::vector<std::uint64_t> sums = checksums_of(array, begin, end);
    std::vector<std::byte> edge(static_cast<std::size_t>(array.block));
    for (std::int64_t block = begin; block < end; ++block) {
        const std::int64_t start = block * array.block, bytes = std::min(array.block, array.bytes() - start);
        const std::int64_t from = std::max(start, first), to = std::min(start + bytes, first + size);
        const std::span<std::byte> wanted = out.subspan(static_cast<std::size_t>(from - first), static_cast<std::size_t>(to - from));
        const bool is_whole = to - from == bytes;
        const std::span<std::byte> whole = is_whole ? wanted : std::span(edge).first(static_cast<std::size_t>(bytes));
        read_fully(*file_, path_, array.offset + start, whole);
        if (checksum(whole) != sums[static_cast<std::size_t>(block - begin)])
            damaged(array.name + ", block " + std::to_string(block), "its checksum is wrong");
        if (!is_whole) std::memcpy(wanted.data(), whole.data() + (from - start), wanted.size());
    }
}

std::vector<StoredChunk> Container::chunk_table(const StoredArray& array, std::int64_t first, std::int64_t last) const {
    std::vector<StoredChunk> chunks(static_cast<std::size_t>(last - first));
    read_fully(*file_, path_, array.checksums + 24 * first, std::as_writable_bytes(std::span(chunks)));
    return chunks;
}

std::vector<StoredChunk> Container::chunks_of(const StoredArray& array, std::int64_t first, std::int64_t last) const {
    std::vector<StoredChunk> chunks = chunk_table(array, first, last);
    const auto size = static_cast<std::uint64_t>(file_size_);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        if (chunks[i].offset > size || chunks[i].bytes > size - chunks[i].offset)
            damaged(array.name + ", chunk " + std::to_string(first + static_cast<std::int64_t>(i)), "it lies outside the file");
    }
    std::vector<FileRange> ranges;
    for (const StoredChunk& chunk : chunks) ranges.push_back(range_of(chunk));
    fetch(std::move(ranges));
    return chunks;
}

std::vector<std::byte> Container::read_chunk(const StoredArray& array, std::int64_t number, const StoredChunk& chunk) const {
    std::vector<std::byte> packed(static_cast<std::size_t>(chunk.bytes));
    read_fully(*file_, path_, static_cast<std::int64_t>(chunk.offset), packed);
    if (checksum(packed) != chunk.checksum) damaged(array.name + ", chunk " + std::to_string(number), "its checksum is wrong");
    return packed;
}

void Container::read_chunks(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const {
    const auto size = static_cast<std::int64_t>(out.size());
    const std::int64_t begin = first / array.block, end = (first + size + array.block - 1) / array.block;
    const std::vector<StoredChunk> chunks = chunks_of(array, begin, end);
    for_each_block(0, end - begin, [&](std::int64_t i) {
        const std::int64_t start = (begin + i) * array.block, from = std::max(start, first);
        const std::int64_t to = std::min(start + array.block, first + size);
        const std::span<std::byte> wanted = out.subspan(static_cast<std::size_t>(from - first), static_cast<std::size_t>(to - from));
        const std::vector<std::byte> packed = read_chunk(array, begin + i, chunks[static_cast<std::size_t>(i)]);
        std::vector<std::byte> raw(static_cast<std::size_t>(to - from == array.block ? 0 : array.block));
        if (!decode_chunk(packed, size_of_type(array.type), raw.empty() ? wanted : std::span(raw)))
            damaged(array.name + ", chunk " + std::to_string(begin + i), "it cannot be decompressed");
        if (!raw.empty()) std::memcpy(wanted.data(), raw.data() + (from - start), wanted.size());
    });
}

void Container::for_each_chunk(const StoredArray& array, const std::function<void(std::span<const std::byte>)>& use) const {
    const std::vector<StoredChunk> chunks = chunks_of(array, 0, array.blocks());
    for (std::size_t i = 0; i < chunks.size(); ++i) use(read_chunk(array, static_cast<std::int64_t>(i), chunks[i]));
}

void Container::check_inside(const StoredArray& array, std::int64_t first, std::size_t bytes) const {
    const auto size = static_cast<std::int64_t>(bytes);
    if (first < 0 || first > array.bytes() - size || array.chunk > 0) damaged(array.name, "requested bytes are outside the array");
}

void Container::read_unchecked(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const {
    check_inside(array, first, out.size());
    read_fully(*file_, path_, array.offset + first, out);
}

bool Container::read_if_present(const StoredArray& array, std::int64_t first, std::span<std::byte> out) const {
    check_inside(array, first, out.size());
    return isoatlas::read_if_present(*file_, path_, array.offset + first, out);
}

void Container::check_all() const {
    for (const StoredArray& array : all_arrays_) {
        if (array.block == 0) continue;
        (void)index_of(array);
        std::vector<std::byte> block(static_cast<std::size_t>(std::min(array.block, array.bytes())));
        for (std::int64_t first = 0; first < array.bytes(); first += array.block)
            read(array, first, std::span(block).first(static_cast<std::size_t>(std::min(array.block, array.bytes() - first))));
    }
    if (contents_.version >= 3) check_nothing_is_left_out();  // by the parts that are correct
}

}  // namespace isoatlas
