#include "formats/common/read_ahead.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

namespace isoatlas {
namespace {

class ReadAheadFile final : public File {
public:
    explicit ReadAheadFile(std::unique_ptr<File> file) : file_(std::move(file)) {}

    [[nodiscard]] std::int64_t size() const override { return file_->size(); }
    [[nodiscard]] std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        if (out.size() <= kSmall) {
            const std::lock_guard hold(lock_);
            if (!blocks_[0].holds(offset, out.size())) std::swap(blocks_[0], blocks_[1]);
            if (blocks_[0].holds(offset, out.size()) || blocks_[0].load(*file_, offset, out.size())) return blocks_[0].copy(offset, out);
        }
        return file_->read_at(offset, out);
    }
    void prefetch(std::int64_t offset, std::int64_t bytes) override { file_->prefetch(offset, bytes); }
    void prefetch_ranges(std::span<const FileRange> ranges) override { file_->prefetch_ranges(ranges); }
    void fetch_ranges(std::span<const FileRange> ranges) override { file_->fetch_ranges(ranges); }
    [[nodiscard]] int close() override { return file_->close(); }

private:
    static constexpr std::size_t kSmall = 1024;

    struct Block {
        std::array<std::byte, 4096> bytes;
        std::int64_t begin = 0, size = 0;

        [[nodiscard]] bool holds(std::int64_t offset, std::size_t count) const {
            return offset >= begin && offset - begin <= size - static_cast<std::int64_t>(count);
        }
        /// Returns whether it holds so many bytes then.
        bool load(File& file, std::int64_t offset, std::size_t count) {
            begin = offset;
            size = std::max<std::int64_t>(file.read_at(offset, bytes), 0);
            return holds(offset, count);
        }
        std::ptrdiff_t copy(std::int64_t offset, std::span<std::byte> out) const {
            std::copy_n(bytes.begin() + (offset - begin), out.size(), out.begin());
            return std::ssize(out);
        }
    };

    std::unique_ptr<File> file_;
    std::array<Block, 2> blocks_{};  ///< the first one was used last
    std::mutex lock_;
};

}  // namespace

std::unique_ptr<File> with_read_ahead(std::unique_ptr<File> file) { return std::make_unique<ReadAheadFile>(std::move(file)); }

}  // namespace isoatlas
