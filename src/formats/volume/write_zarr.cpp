// Writes OME-Zarr 0.4: a folder of Zarr version 2, with the levels of resolution that viewers want.
#include <algorithm>
#include <string>

#include "formats/common/text.h"
#include "formats/volume/write_zarr.h"
#include "formats/volume/zarr_levels.h"

namespace isoatlas {
namespace {

/// The values that a viewer shows from black to white: all of them.
Json window_of(const Volume& volume) {
    double low = 0, high = 0;
    visit_samples(volume, [&](auto samples) {
        if (samples.empty()) return;
        const auto [least, greatest] = std::ranges::minmax_element(samples);
        low = static_cast<double>(*least), high = static_cast<double>(*greatest);
    });
    return {{"min", low}, {"max", high}, {"start", low}, {"end", high}};
}

}  // namespace

bool is_zarr_name(const std::string& path) {
    std::string name = path;
    while (name.ends_with('/')) name.pop_back();
    return ends_with_ignoring_case(name, ".zarr");
}

void refuse_zarr_sink(const std::string& name) {
    throw Error(ErrorKind::usage, {.file = name,
                                   .what = "OME-Zarr is a folder, not one file",
                                   .expected = "the name of a new folder on disk",
                                   .next = "choose another format, or write it to a path"});
}

void write_ome_zarr(const std::string& path, const Volume& volume) {
    FolderOutput folder(path);
    folder.put(".zgroup", kZarrGroup);
    const std::string name = volume.info.description.empty() ? "volume" : volume.info.description;
    const std::span<const std::byte> samples(volume.bytes.data(), volume.bytes.size());
    Json attributes;
    attributes["multiscales"] = write_zarr_levels(folder, "", name, volume.info, samples, Coarsening::mean);
    const Json channel{{"label", "values"}, {"color", "FFFFFF"}, {"active", true}, {"window", window_of(volume)}};
    attributes["omero"] = {{"version", "0.4"}, {"channels", Json::array({channel})}, {"rdefs", {{"model", "greyscale"}}}};
    attributes["isoatlas"] = zarr_remainder(volume.info);
    folder.put(".zattrs", attributes.dump(1, ' ', true, Json::error_handler_t::replace));
    folder.commit();
}

}  // namespace isoatlas
