// The volume file of the command line, or the part of it that --box names.
#pragma once

#include <memory>
#include <optional>

#include "options/arguments.h"

namespace isoatlas::cli {

struct Input {
    std::unique_ptr<VolumeReader> reader;
    std::optional<SampleBox> box;  ///< of the reader's samples: what is left to be cut out when they are filtered
};

/// Opens arguments.file. With --box the reader has the samples of the box alone, and with --gaussian those that the filter needs around it.
/// Throws as open_volume().
[[nodiscard]] Input open_input(const Arguments& arguments);

}  // namespace isoatlas::cli
