// The OpenVDB reader takes any bytes: a documented error or a sound volume.
#include "formats/volume/formats.h"
#include "fuzz/volume_target.h"

namespace {

/// The last grid of several.
std::unique_ptr<isoatlas::VolumeReader> open_last(const std::string& path, isoatlas::OpenOptions options) {
    try {
        return isoatlas::open_vdb(path, options);
    } catch (const isoatlas::Error& error) {
        if (error.kind() != isoatlas::ErrorKind::usage || error.text().choices.size() < 2) throw;
        options.dataset = error.text().choices.back().word;
    }
    return isoatlas::open_vdb(path, options);
}

/// With a box, so that a box of active voxels larger than the memory is no error: it is read in parts.
std::unique_ptr<isoatlas::VolumeReader> open_part(const std::string& path, isoatlas::OpenOptions options) {
    options.box = isoatlas::SampleBox{{0, 0, 0}, {1, 1, 1}};
    std::unique_ptr<isoatlas::VolumeReader> reader = open_last(path, options);
    const isoatlas::VolumeInfo& info = reader->info();
    std::vector<std::byte> sample(isoatlas::size_of(info.type));
    reader->read_box({info.extent.size - isoatlas::Index3{1, 1, 1}, info.extent.size}, sample);
    return reader;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzz::open_and_read([](const std::string& path, const isoatlas::OpenOptions& options) { return open_part(path, options); }, data,
                               size);
}
