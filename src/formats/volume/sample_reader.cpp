#include "formats/volume/sample_reader.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "base/check.h"
#include "isoatlas/text.h"
#include "isoatlas/units.h"

namespace isoatlas {
namespace {

std::string shape_text(const Extent& extent) {
    std::string text = std::to_string(extent.size[0]);
    for (int axis = 1; axis < extent.rank; ++axis) text += " x " + std::to_string(extent.size[axis]);
    return text;
}

class SampleReader final : public VolumeReader {
public:
    SampleReader(VolumeInfo info, std::unique_ptr<ByteSource> source, bool skip_rest, const TimeStep& step, WideInteger wide)
        : source_(std::move(source)),
          skip_rest_(skip_rest),
          wide_{.type = wide},
          slice_bytes_(info.extent.slice() * static_cast<std::int64_t>(size_of(info.type))) {
        info_ = std::move(info);
        if (wide != WideInteger::none) info_.notes.push_back(note_of(wide));
        tidy_texts(info_);
        info_.slab_readable = source_->random_access();
        info_.volumes.time_steps = step.count, info_.volumes.time_step = step.index;
        begin_ = step.index * info_.extent.size[2] * slice_bytes_;
        wanted_ = step.count * info_.extent.size[2] * slice_bytes_;
        if (source_->random_access()) check_end();
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        ISOATLAS_CHECK(0 <= z_begin && z_begin <= z_end && z_end <= info_.extent.size[2]);
        ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) == (z_end - z_begin) * slice_bytes_);
        source_->seek(begin_ + z_begin * slice_bytes_);
        source_->read(out);
        if (needs_swap(info_.big_endian)) swap_bytes(out, size_of(info_.type));
        doubles_of_integers(out, wide_, info_.path);
        if (z_end == info_.extent.size[2] && z_begin < z_end) check_end();
    }

private:
    void check_end() {
        if (end_checked_) return;
        const std::int64_t rest = require_end(*source_, wanted_, skip_rest_);
        end_checked_ = true;
        if (rest == 0) return;
        const std::string bytes = std::to_string(rest) + (rest == 1 ? " byte after the samples was" : " bytes after the samples were");
        info_.notes.push_back(bytes + " ignored (" + shown_name(source_->file()) + ")");
    }

    std::unique_ptr<ByteSource> source_;
    bool skip_rest_;
    WideIntegers wide_;
    std::int64_t slice_bytes_;
    std::int64_t begin_ = 0, wanted_ = 0;  ///< of this volume; of all volumes
    bool end_checked_ = false;
};

using Pairs = std::uint16_t __attribute__((vector_size(16)));
using Quads = std::uint32_t __attribute__((vector_size(16)));
using Octets = std::uint64_t __attribute__((vector_size(16)));

/// Reverses the bytes of numbers of kBytes, sixteen bytes at a time: the halves of ever wider numbers are exchanged, which every processor
/// does for all at once; a reversal of one number is not vectorised.
template <std::size_t kBytes>
void swap_each(std::span<std::byte> samples) {
    const auto swap = [](std::byte* at, std::size_t size) {
        Pairs pairs{};
        std::memcpy(&pairs, at, size);
        pairs = pairs >> 8 | pairs << 8;
        auto quads = reinterpret_cast<Quads>(pairs);
        if constexpr (kBytes >= 4) quads = quads >> 16 | quads << 16;
        auto octets = reinterpret_cast<Octets>(quads);
        if constexpr (kBytes >= 8) octets = octets >> 32 | octets << 32;
        std::memcpy(at, &octets, size);
    };
    std::size_t done = 0;
    for (; done + sizeof(Pairs) <= samples.size(); done += sizeof(Pairs)) swap(samples.data() + done, sizeof(Pairs));
    swap(samples.data() + done, (samples.size() - done) / kBytes * kBytes);
}

}  // namespace

std::int64_t sample_bytes(const std::string& path, const Extent& extent, ValueType type, std::int64_t volumes) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    std::int64_t bytes = static_cast<std::int64_t>(size_of(type));
    for (const std::int64_t factor : {extent.size[0], extent.size[1], extent.size[2], volumes}) {
        if (factor < 1) {
            throw Error(ErrorKind::input, {.file = path,
                                           .where = "header",
                                           .what = "an axis has " + std::to_string(factor) + " samples",
                                           .expected = "at least 1",
                                           .next = "the header is damaged: get the file again or correct it"});
        }
        if (bytes > kMost / factor) {
            throw Error(ErrorKind::input, {.file = path,
                                           .where = "header",
                                           .what = "the sizes " + shape_text(extent) + " do not fit in 63 bits",
                                           .next = "the header is damaged: get the file again or correct it"});
        }
        bytes *= factor;
    }
    return bytes;
}

std::unique_ptr<VolumeReader> make_sample_reader(VolumeInfo info, std::unique_ptr<ByteSource> source, const OpenOptions& options,
                                                 const TimeStep& step, WideInteger wide) {
    const std::int64_t wanted = sample_bytes(info.path, info.extent, info.type, step.count);
    const std::int64_t bound = source->size_bound();
    if (wanted > bound) {
        const std::string volumes = step.count > 1 ? std::to_string(step.count) + " volumes of " : "";
        const std::string holds =
            (source->random_access() ? "the file holds " : "the file cannot hold more than ") + std::to_string(bound) + " bytes of samples";
        throw Error(ErrorKind::input,
                    {.file = source->file(),
                     .where = "samples",
                     .what = holds,
                     .expected = std::to_string(wanted) + " bytes for " + volumes + shape_text(info.extent) + " " + name_of(info.type),
                     .next = "the file is truncated or its header is wrong: get it again"});
    }
    return std::make_unique<SampleReader>(std::move(info), std::move(source), options.skip_rest, step, wide);
}

void tidy_texts(VolumeInfo& info) {
    info.description = header_text(info.description, /*lines=*/true);
    for (std::string* text : {&info.value_unit, &info.geometry.unit, &info.geometry.space, &info.volumes.time_unit})
        *text = header_text(*text);
    info.geometry.unit = unit_name(info.geometry.unit);
    for (std::string& note : info.notes) note = header_text(note);
    for (std::string& channel : info.volumes.channels) channel = header_text(channel);
}

void swap_bytes(std::span<std::byte> samples, std::size_t bytes_per_sample) {
    if (bytes_per_sample == 2) swap_each<2>(samples);
    if (bytes_per_sample == 4) swap_each<4>(samples);
    if (bytes_per_sample == 8) swap_each<8>(samples);
}

bool needs_swap(bool big_endian) { return big_endian != (std::endian::native == std::endian::big); }

}  // namespace isoatlas
