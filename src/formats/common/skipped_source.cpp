#include <algorithm>
#include <limits>
#include <utility>

#include "formats/common/byte_source.h"

namespace isoatlas {
namespace {

class SkippedSource final : public ByteSource {
public:
    SkippedSource(std::unique_ptr<ByteSource> source, std::int64_t begin) : source_(std::move(source)), begin_(begin) {}
    void read(std::span<std::byte> out) override { source_->read(out); }
    void seek(std::int64_t offset) override { source_->seek(begin_ + offset); }
    std::int64_t payload_bytes(std::int64_t max) override {
        const std::int64_t all = std::min(max, std::numeric_limits<std::int64_t>::max() - begin_ - 1) + begin_;
        return std::max<std::int64_t>(source_->payload_bytes(all) - begin_, 0);
    }
    bool random_access() const override { return source_->random_access(); }
    std::int64_t size_bound() const override { return std::max<std::int64_t>(source_->size_bound() - begin_, 0); }
    const std::string& file() const override { return source_->file(); }

private:
    std::unique_ptr<ByteSource> source_;
    std::int64_t begin_;
};

}  // namespace

std::unique_ptr<ByteSource> skip_bytes(std::unique_ptr<ByteSource> source, std::int64_t offset) {
    return std::make_unique<SkippedSource>(std::move(source), offset);
}

}  // namespace isoatlas
