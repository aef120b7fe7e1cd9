// slab_reader: a volume reader around a function of the caller.
#include <utility>

#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

class SlabReader : public VolumeReader {
public:
    using Read = std::function<void(std::int64_t, std::int64_t, std::span<std::byte>)>;

    SlabReader(VolumeInfo info, Read read) : read_(std::move(read)) {
        info_ = std::move(info);
        info_.slab_readable = true;
    }
    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override { read_(z_begin, z_end, out); }

private:
    Read read_;
};

}  // namespace

std::unique_ptr<VolumeReader> slab_reader(VolumeInfo info,
                                          std::function<void(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out)> read) {
    for (const std::int64_t size : info.extent.size) {
        if (size < 1) throw Error(ErrorKind::usage, {.what = "the extent of a volume must be positive"});
    }
    return std::make_unique<SlabReader>(std::move(info), std::move(read));
}

}  // namespace isoatlas
