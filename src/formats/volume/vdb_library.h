// Code that uses the library OpenVDB. A program links it (vdb_library.cpp), or loads it when it first meets such a file
// (formats/on_demand): the loader of the system takes 40 ms for OpenVDB at every start.
#pragma once

#include <memory>
#include <string>

#include "formats/common/volume_file.h"
#include "formats/volume/formats.h"

namespace isoatlas {

/// As open_vdb(), write_vdb() and write_vdb_labels().
struct VdbLibrary {
    std::unique_ptr<VolumeReader> (*open)(const std::string& path, const OpenOptions& options);
    void (*write)(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
    void (*write_labels)(Sink& sink, const VolumeInfo& info, const SampleFeed& samples);
};

extern const VdbLibrary kOpenVdb;  ///< vdb_openvdb.cpp, where the build has it

/// file: that needs it. Throws Error{unsupported, Reason::built_without_format}.
[[nodiscard]] const VdbLibrary& vdb_library(const std::string& file);

}  // namespace isoatlas
