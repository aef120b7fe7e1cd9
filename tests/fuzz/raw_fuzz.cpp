// RAW: the input is the sidecar (and the name): a documented error or a sound description.
#include "formats/volume/raw_description.h"
#include "fuzz/volume_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::OnlyContent in_use(std::as_bytes(std::span(data, size)));
    const std::string name(reinterpret_cast<const char*>(data), std::min<std::size_t>(size, 200));
    for (const bool sidecar : {true, false}) {
        try {
            const isoatlas::RawDescription found = sidecar ? isoatlas::read_sidecar("fuzz.json") : isoatlas::description_from_name(name);
            if (found.dims) {
                fuzz::require_volume(found.dims->size() == 2 || found.dims->size() == 3);
                for (const std::int64_t extent : *found.dims) fuzz::require_volume(extent >= 1);
            }
            fuzz::require_volume(!found.skip_bytes || *found.skip_bytes >= 0);
        } catch (const isoatlas::Error& error) {
            fuzz::require_volume(error.kind() == isoatlas::ErrorKind::input);
        }
    }
    return 0;
}
