#include "formats/volume/half_source.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kHalf = 2, kFloat = 4;

class HalfSource final : public ByteSource {
public:
    HalfSource(std::unique_ptr<ByteSource> source, bool big_endian) : source_(std::move(source)), swap_(needs_swap(big_endian)) {}

    void read(std::span<std::byte> out) override {
        ISOATLAS_CHECK(out.size() % kFloat == 0);
        constexpr std::size_t kSamples = 1 << 15;
        halves_.resize(std::min(kSamples, out.size() / kFloat));
        for (std::size_t done = 0; done < out.size() / kFloat;) {
            const std::size_t count = std::min(kSamples, out.size() / kFloat - done);
            const std::span<std::byte> bytes = std::as_writable_bytes(std::span(halves_).first(count));
            source_->read(bytes);
            if (swap_) swap_bytes(bytes, kHalf);
            for (std::size_t i = 0; i < count; ++i) {
                const float value = float_of_half(halves_[i]);
                std::memcpy(out.data() + (done + i) * kFloat, &value, kFloat);
            }
            done += count;
        }
    }
    void seek(std::int64_t offset) override {
        ISOATLAS_CHECK(offset % kFloat == 0);
        source_->seek(offset / kFloat * kHalf);
    }
    [[nodiscard]] std::int64_t payload_bytes(std::int64_t max) override { return doubled(source_->payload_bytes(max / 2)); }
    [[nodiscard]] bool random_access() const override { return source_->random_access(); }
    [[nodiscard]] std::int64_t size_bound() const override { return doubled(source_->size_bound()); }
    [[nodiscard]] const std::string& file() const override { return source_->file(); }

private:
    static std::int64_t doubled(std::int64_t bytes) { return bytes > std::numeric_limits<std::int64_t>::max() / 2 ? bytes : 2 * bytes; }

    std::unique_ptr<ByteSource> source_;
    bool swap_;
    std::vector<std::uint16_t> halves_;
};

}  // namespace

std::unique_ptr<ByteSource> widen_halves(std::unique_ptr<ByteSource> source, bool big_endian) {
    return std::make_unique<HalfSource>(std::move(source), big_endian);
}

}  // namespace isoatlas
