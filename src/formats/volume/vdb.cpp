#include "formats/volume/vdb.h"

#include <string_view>

#include "formats/volume/formats.h"
#include "formats/volume/vdb_library.h"

namespace isoatlas {

bool looks_like_vdb(FirstBytes first, const std::string&) {
    constexpr std::string_view kFileBegin("\x20\x42\x44\x56\0\0\0\0", 8);
    return std::string_view(reinterpret_cast<const char*>(first.data()), first.size()).starts_with(kFileBegin);
}

std::unique_ptr<VolumeReader> open_vdb(const std::string& path, const OpenOptions& options) {
    return vdb_library(path).open(path, options);
}
void write_vdb(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { vdb_library(sink.name()).write(sink, info, samples); }
void write_vdb_labels(Sink& sink, const VolumeInfo& info, const SampleFeed& samples) {
    vdb_library(sink.name()).write_labels(sink, info, samples);
}

}  // namespace isoatlas
