// Collection: a folder of stores, one for each channel and time step of a volume file, with an index, collection.json
// (docs/format.md#collections).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Channels and time steps of a file, as FileVolumes has them.
struct Channels {
    std::vector<std::string> names{""};  ///< at least one; "" where the file gives none
    std::int64_t time_steps = 1;
    std::vector<double> times;  ///< of the time steps, in time_unit; empty: the file does not say
    std::string time_unit;

    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(names.size()) * time_steps; }
    /// Volumes are numbered from 0, the channels of a time step one after the other.
    [[nodiscard]] std::int64_t channel_of(std::int64_t volume) const { return volume % static_cast<std::int64_t>(names.size()); }
    [[nodiscard]] std::int64_t time_step_of(std::int64_t volume) const { return volume / static_cast<std::int64_t>(names.size()); }
    bool operator==(const Channels&) const = default;
};

/// Of the file that a volume is one of.
[[nodiscard]] Channels channels_of(const FileVolumes& volumes);

struct Collection {
    std::string folder;  ///< path or address
    std::string volume;  ///< name of the file
    Channels channels;
    std::vector<std::string> stores;  ///< names in the folder, by number: Channels::count() of them

    [[nodiscard]] std::string path_of(std::int64_t number) const;
};

/// "channel-03_time-0012.atlas", with as many digits as the last one needs; what there is one of is left out: "volume.atlas" of one volume.
[[nodiscard]] std::string store_name(const Channels& channels, std::int64_t volume);

/// Whether `path` is a folder that holds collection.json, or this file, also an address of it. Never throws.
[[nodiscard]] bool is_collection(const std::string& path);
/// Throws Error{input}: no such file, damaged, names that lead out of the folder. The stores are not opened.
[[nodiscard]] Collection read_collection(const std::string& path);
/// Writes the index: under its name is the old one or this. Throws Error{resource}.
void write_collection(const Collection& collection);

/// The number of options.channel and options.time_step, each optional where there is one. Throws Error{usage} with the list of them.
[[nodiscard]] std::int64_t choose_volume(const Collection& collection, const OpenOptions& options);

}  // namespace isoatlas
