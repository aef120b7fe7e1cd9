// box_reader: the samples of a box of another reader.
#include <algorithm>
#include <utility>

#include "base/check.h"
#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

class BoxReader final : public VolumeReader {
public:
    BoxReader(std::unique_ptr<VolumeReader> whole, const SampleBox& box) : whole_(std::move(whole)), box_(box) {
        info_ = whole_->info();
        info_.extent.size = box.size();
        info_.geometry = geometry_of(info_.geometry, box);
        info_.chunk = min(info_.chunk, info_.extent.size);
        known_notes_ = info_.notes.size();
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        read_box({{0, 0, z_begin}, {info_.extent.size[0], info_.extent.size[1], z_end}}, out);
    }

    void read_box(const SampleBox& box, std::span<std::byte> out) override {
        ISOATLAS_CHECK(is_inside(box, info_.extent));
        whole_->read_box({box.begin + box_.begin, box.end + box_.begin}, out);
        const std::vector<std::string>& notes = whole_->info().notes;  // those about the end of the file come while it is read
        for (; known_notes_ < notes.size(); ++known_notes_) info_.notes.push_back(notes[known_notes_]);
    }

private:
    std::unique_ptr<VolumeReader> whole_;
    SampleBox box_;
    std::size_t known_notes_ = 0;
};

}  // namespace

std::unique_ptr<VolumeReader> box_reader(std::unique_ptr<VolumeReader> whole, const SampleBox& box) {
    const VolumeInfo& info = whole->info();
    if (!is_inside(box, info.extent)) {
        std::string size = std::to_string(info.extent.size[0]), given;
        for (int axis = 0; axis < info.extent.rank; ++axis) {
            if (axis > 0) size += " x " + std::to_string(info.extent.size[axis]), given += ",";
            given += std::to_string(box.begin[axis]) + ":" + std::to_string(box.end[axis]);
        }
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "the box " + given + " does not lie inside the volume",
                                       .expected = "FIRST:END for each axis, samples of a volume of " + size,
                                       .next = "choose a box inside the volume"});
    }
    return std::make_unique<BoxReader>(std::move(whole), box);
}

}  // namespace isoatlas
