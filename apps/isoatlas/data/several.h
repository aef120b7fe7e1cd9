// Files of several channels or time steps, and collections of stores (`isoatlas build --all`): which of their volumes a command is about.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "options/arguments.h"

namespace isoatlas::cli {

struct Several {
    Arguments arguments;  ///< of the command line, before anything is assumed about one of the volumes
    Channels channels;
    std::optional<Collection> collection;  ///< where there are stores of them
    std::int64_t first = 0;                ///< the volume that the options choose, or the first
};

/// The arguments of a command about one of the volumes.
[[nodiscard]] Arguments of_volume(const Several& several, std::int64_t volume);
/// The word that chooses a channel: its name, or its number where others have the same.
[[nodiscard]] std::string channel_word(const Channels& channels, std::int64_t volume);
/// "channel GFP, time step 3", for messages; "" of one.
[[nodiscard]] std::string volume_text(const Channels& channels, std::int64_t volume);

/// Opens arguments.file; where the user has left a channel or time step open, the first one, with a note. Throws as open_input().
[[nodiscard]] std::unique_ptr<VolumeReader> open_first(Arguments& arguments, std::vector<std::string>& notes);

/// Replaces a collection by the store that the options choose. The viewer and `info` take the first where nothing is chosen, and have
/// arguments.several; of a volume file of several, the viewer too. Throws Error: usage (a choice is needed, or is not there), input (the
/// index is damaged).
void choose_one(Arguments& arguments);

}  // namespace isoatlas::cli
