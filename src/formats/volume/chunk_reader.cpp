#include "formats/volume/chunk_reader.h"

#include <list>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/check.h"
#include "field/copy_box.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

/// The chunks read last, by their number.
class ChunkCache {
public:
    explicit ChunkCache(std::int64_t budget) : budget_(budget) {}

    /// nullptr: not there. Valid until the next call of add().
    const std::vector<std::byte>* find(std::int64_t number) {
        const auto found = places_.find(number);
        if (found == places_.end()) return nullptr;
        order_.splice(order_.begin(), order_, found->second);
        return &found->second->samples;
    }

    const std::vector<std::byte>& add(std::int64_t number, std::vector<std::byte> samples) {
        bytes_ += static_cast<std::int64_t>(samples.size());
        order_.push_front({number, std::move(samples)});
        places_[number] = order_.begin();
        while (bytes_ > budget_ && order_.size() > 1) {
            bytes_ -= static_cast<std::int64_t>(order_.back().samples.size());
            places_.erase(order_.back().number);
            order_.pop_back();
        }
        return order_.front().samples;
    }

private:
    struct Entry {
        std::int64_t number;
        std::vector<std::byte> samples;
    };
    std::list<Entry> order_;  ///< the one used last is the first
    std::unordered_map<std::int64_t, std::list<Entry>::iterator> places_;
    std::int64_t bytes_ = 0, budget_;
};

class ChunkReader final : public VolumeReader {
public:
    ChunkReader(VolumeInfo info, ReadChunk read_chunk, std::int64_t cache_bytes) : read_chunk_(std::move(read_chunk)), cache_(cache_bytes) {
        info_ = std::move(info);
        tidy_texts(info_);
        info_.slab_readable = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ISOATLAS_CHECK(info_.chunk[axis] > 0);
            chunks_[axis] = (info_.extent.size[axis] - 1) / info_.chunk[axis] + 1;
        }
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        if (z_begin < z_end) read_box({{0, 0, z_begin}, {info_.extent.size[0], info_.extent.size[1], z_end}}, out);
    }

    void read_box(const SampleBox& box, std::span<std::byte> out) override {
        ISOATLAS_CHECK(is_inside(box, info_.extent));
        ISOATLAS_CHECK(out.size() == static_cast<std::size_t>(box.size().product()) * size_of(info_.type));
        const auto first = [&](std::size_t axis) { return box.begin[axis] / info_.chunk[axis]; };
        const auto last = [&](std::size_t axis) { return (box.end[axis] - 1) / info_.chunk[axis]; };
        for (std::int64_t z = first(2); z <= last(2); ++z) {
            for (std::int64_t y = first(1); y <= last(1); ++y) {
                for (std::int64_t x = first(0); x <= last(0); ++x) take(box, {x, y, z}, out);
            }
        }
    }

private:
    void take(const SampleBox& box, const Index3& chunk, std::span<std::byte> out) {
        const Index3& size = info_.chunk;
        const Index3 corner{chunk[0] * size[0], chunk[1] * size[1], chunk[2] * size[2]};
        const Index3 inside = min(corner + size, info_.extent.size);
        const Index3 begin = max(corner, box.begin), end = min(inside, box.end);
        if (const std::span<std::byte> place = whole_in(box, begin, end, out); !place.empty() && cache_.find(number_of(chunk)) == nullptr)
            return read_chunk_(chunk, place);
        const std::vector<std::byte>& samples = chunk_of(chunk, begin == corner && end == inside);
        copy_box(end - begin, {samples, size, begin - corner}, {out, box.size(), begin - box.begin}, size_of(info_.type));
    }

    /// Where a whole chunk lies in `out`, if it does in one piece and needs no copy; else empty. begin, end: of what the box takes of it.
    [[nodiscard]] std::span<std::byte> whole_in(const SampleBox& box, const Index3& begin, const Index3& end,
                                                std::span<std::byte> out) const {
        const Index3 &chunk = info_.chunk, wide = box.size();
        const bool is_one_piece = wide[0] == chunk[0] && (wide[1] == chunk[1] || chunk[2] == 1);
        if (!is_one_piece || end - begin != chunk) return {};
        const Index3 at = begin - box.begin;
        const std::size_t sample = size_of(info_.type);
        return out.subspan(static_cast<std::size_t>(at[0] + wide[0] * (at[1] + wide[1] * at[2])) * sample,
                           static_cast<std::size_t>(chunk.product()) * sample);
    }

    [[nodiscard]] std::int64_t number_of(const Index3& chunk) const { return chunk[0] + chunks_[0] * (chunk[1] + chunks_[1] * chunk[2]); }

    /// is_whole: no other box needs it soon.
    const std::vector<std::byte>& chunk_of(const Index3& chunk, bool is_whole) {
        const std::int64_t number = number_of(chunk);
        if (const std::vector<std::byte>* found = cache_.find(number)) return *found;
        scratch_.resize(static_cast<std::size_t>(info_.chunk.product()) * size_of(info_.type));
        read_chunk_(chunk, scratch_);
        return is_whole ? scratch_ : cache_.add(number, std::exchange(scratch_, {}));
    }

    ReadChunk read_chunk_;
    ChunkCache cache_;
    Index3 chunks_{};  ///< along each axis
    std::vector<std::byte> scratch_;
};

}  // namespace

std::unique_ptr<VolumeReader> make_chunk_reader(VolumeInfo info, ReadChunk read_chunk, std::int64_t cache_bytes) {
    return std::make_unique<ChunkReader>(std::move(info), std::move(read_chunk), cache_bytes);
}

}  // namespace isoatlas
