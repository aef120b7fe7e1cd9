#include "formats/volume/component_source.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kComponentBytes = std::int64_t{1} << 18;

class ComponentSource final : public ByteSource {
public:
    ComponentSource(std::unique_ptr<ByteSource> source, std::int64_t sample, std::int64_t components, std::int64_t index)
        : source_(std::move(source)), sample_(sample), components_(components), tuple_(sample * components), begin_(sample * index) {
        source_->seek(0);
    }

    void read(std::span<std::byte> out) override {
        const auto sample = static_cast<std::size_t>(sample_), tuple = static_cast<std::size_t>(tuple_);
        ISOATLAS_CHECK(out.size() % sample == 0);
        const std::size_t at_once = static_cast<std::size_t>(std::max<std::int64_t>(kComponentBytes / tuple_, 1));
        for (std::size_t done = 0, all = out.size() / sample; done < all;) {
            const std::size_t count = std::min(at_once, all - done);
            buffer_.resize(count * tuple);
            source_->read(buffer_);
            for (std::size_t i = 0; i < count; ++i)
                std::memcpy(out.data() + (done + i) * sample, buffer_.data() + i * tuple + static_cast<std::size_t>(begin_), sample);
            done += count;
        }
    }
    void seek(std::int64_t offset) override {
        ISOATLAS_CHECK(offset % sample_ == 0);
        source_->seek(offset * components_);
    }
    /// A tuple that is not whole counts as one byte more.
    std::int64_t payload_bytes(std::int64_t max) override {
        constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
        const std::int64_t bytes = source_->payload_bytes(max >= kMax / components_ ? kMax - 1 : max * components_);
        return bytes / tuple_ * sample_ + (bytes % tuple_ == 0 ? 0 : 1);
    }
    bool random_access() const override { return source_->random_access(); }
    std::int64_t size_bound() const override { return source_->size_bound() / tuple_ * sample_; }
    const std::string& file() const override { return source_->file(); }

private:
    std::unique_ptr<ByteSource> source_;
    std::int64_t sample_, components_, tuple_, begin_;
    std::vector<std::byte> buffer_;
};

}  // namespace

std::unique_ptr<ByteSource> pick_component(std::unique_ptr<ByteSource> source, std::int64_t sample_bytes, std::int64_t components,
                                           std::int64_t index) {
    ISOATLAS_CHECK(components >= 1 && index >= 0 && index < components && sample_bytes >= 1);
    if (components == 1) return source;
    return std::make_unique<ComponentSource>(std::move(source), sample_bytes, components, index);
}

}  // namespace isoatlas
