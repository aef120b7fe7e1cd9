// Session: first steps of most verbs. Checks the output path, loads and describes the volume, converts the isovalue.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "options/arguments.h"
#include "text/progress.h"
#include "text/values.h"

namespace isoatlas::cli {

class Terminal;

struct ValueRange {
    double low, high;  ///< stored values
};
[[nodiscard]] ValueRange range_of(const Volume& volume);

class Session {
public:
    Session(const Arguments& arguments, Terminal& terminal) : arguments_(arguments), terminal_(terminal), progress_(terminal) {}

    /// For long calls; valid for the lifetime of the session.
    [[nodiscard]] Context context();
    /// Loads arguments.file, prints one line about it and the notes of the reader. Converts std::bad_alloc to Error{resource}.
    [[nodiscard]] Volume load();
    /// "scan.nrrd  NRRD  512 x 512 x 420  int16  spacing ...  values ..."
    [[nodiscard]] static std::string describe(const VolumeInfo& info, const ValueRange& range);

private:
    const Arguments& arguments_;
    Terminal& terminal_;
    ProgressBar progress_;
};

/// Memory of an analysis in bytes and its time, for few (smooth data) and many (noise) critical elements.
struct Cost {
    double memory_smooth, memory_noise, seconds_smooth, seconds_noise;
};
[[nodiscard]] Cost cost_of_analysis(const VolumeInfo& info, int threads);
/// "memory 210 MB to 1.3 GB, time about 2 s" for messages.
[[nodiscard]] std::string cost_text(const VolumeInfo& info, int threads);

/// Bytes that the machine has; infinity: unknown.
[[nodiscard]] double machine_memory();

/// The samples filtered with --gaussian, then those of a box alone.
[[nodiscard]] Volume shaped(Volume volume, const std::optional<double>& gaussian, const std::optional<SampleBox>& box,
                            const Context& context);

/// What the user says about geometry and units, for a store.
[[nodiscard]] Corrections corrections_of(const Arguments& arguments);

/// The geometry of --voxel.
[[nodiscard]] Geometry voxel_geometry();

/// With its dot, in lower case; empty: there is none.
[[nodiscard]] std::string lower_extension(const std::string& path);

/// Checks the output path before the long work: unknown extension, missing or unwritable folder, output equal to the input.
void check_output(const Arguments& arguments, const std::vector<std::string>& extensions);
/// The same for an output other than that of -o.
void check_output(const Arguments& arguments, const std::string& output, const std::vector<std::string>& extensions);

/// "--dims 4x4x4 --type uint8": the input options again, for suggested commands.
[[nodiscard]] std::string reading_options(const Arguments& arguments);

}  // namespace isoatlas::cli
