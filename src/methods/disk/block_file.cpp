#include "methods/disk/block_file.h"

#include <bit>

#include "codec/checksum.h"
#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers of blocks are little endian");

constexpr std::int64_t kMinBlock = 512, kMaxBlock = std::int64_t{1} << 16;
constexpr std::size_t kMagicBytes = 16;

std::span<const std::byte> payload_of(std::span<const std::byte> block) { return block.first(block.size() - kBlockChecksum); }

std::uint64_t checksum_in(std::span<const std::byte> block) {
    std::uint64_t sum = 0;
    const auto end = block.last(kBlockChecksum);
    std::copy(end.begin(), end.end(), std::as_writable_bytes(std::span(&sum, 1)).begin());
    return sum;
}

bool is_block_size(std::int64_t bytes) {
    return bytes >= kMinBlock && bytes <= kMaxBlock && std::has_single_bit(static_cast<std::uint64_t>(bytes));
}

}  // namespace

BlockWriter::BlockWriter(const std::string& path, std::string_view magic, std::int64_t block_bytes)
    : magic_(magic), block_bytes_(block_bytes), file_(path) {
    if (!is_block_size(block_bytes))
        throw Error(
            ErrorKind::usage,
            {.where = "size of a block", .what = std::to_string(block_bytes) + " bytes", .expected = "a power of two, 512 to 65536"});
}

void BlockWriter::put(std::int64_t number, std::span<const std::byte> payload) {
    std::vector<std::byte> block(payload.begin(), payload.end());
    block.resize(static_cast<std::size_t>(payload_bytes()));
    const std::uint64_t sum = checksum(block);
    const auto bytes = std::as_bytes(std::span(&sum, 1));
    block.insert(block.end(), bytes.begin(), bytes.end());
    file_.write_at(number * block_bytes_, block);
}

std::int64_t BlockWriter::add(std::span<const std::byte> payload) {
    put(blocks_, payload);
    return blocks_++;
}

void BlockWriter::commit(const HeaderNumbers& numbers) {
    PayloadWriter header;
    for (const char letter : magic_) header.put(letter);
    header.put(block_bytes_);
    header.put(blocks_);
    for (const std::int64_t number : numbers) header.put(number);
    put(0, header.bytes());
    file_.commit();
}

BlockReader::BlockReader(std::string path, std::string_view magic) : path_(std::move(path)), file_(open_file(path_)) {
    std::array<std::byte, kMagicBytes + 16> first{};
    if (read_available(*file_, path_, 0, first) < first.size()) fail("the file is too short to be a search structure");
    if (!std::equal(magic.begin(), magic.end(), first.begin(), [](char letter, std::byte byte) { return std::byte(letter) == byte; }))
        fail("this is no search structure of that kind");
    PayloadReader sizes(std::span<const std::byte>(first).subspan(kMagicBytes), *this);
    block_bytes_ = sizes.get<std::int64_t>();
    blocks_ = sizes.get<std::int64_t>();
    if (!is_block_size(block_bytes_) || blocks_ < 1 || blocks_ > file_->size() / block_bytes_ || file_->size() != blocks_ * block_bytes_)
        fail("the file is truncated, or its header is damaged");
    const std::vector<std::byte> header = read(0);
    PayloadReader numbers(std::span<const std::byte>(header).subspan(first.size()), *this);
    for (std::int64_t& number : numbers_) number = numbers.get<std::int64_t>();
}

std::vector<std::byte> BlockReader::read(std::int64_t number) const {
    if (number < 0 || number >= blocks_) fail("a block is referred to that does not exist");
    std::vector<std::byte> block(static_cast<std::size_t>(block_bytes_));
    read_fully(*file_, path_, number * block_bytes_, block);
    if (checksum(payload_of(block)) != checksum_in(block)) fail("block " + std::to_string(number) + " is damaged");
    block.resize(static_cast<std::size_t>(payload_bytes()));
    return block;
}

void BlockReader::fail(const std::string& what) const {
    throw Error(ErrorKind::input, {.file = path_, .what = what, .next = "write it again from the volume"});
}

}  // namespace isoatlas
