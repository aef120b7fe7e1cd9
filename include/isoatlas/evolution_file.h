// EvolutionFile: surfaces of one volume at several isovalues as the steps of one file, for the time slider of ParaView.
//
//   EvolutionFile file("evolution.vtkhdf");
//   for (const double tau : {150.0, 200.0, 250.0}) file.add(extract(volume, tau));
//   file.commit();
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "isoatlas/surface.h"

namespace isoatlas {

/// A VTKHDF file (docs/formats.md#vtkhdf) that is written step by step. Memory: a buffer of 64 KB for each of its arrays and some numbers a
/// step, none of the surfaces. Under its name is nothing, or the old file, until commit(); without it the new one is gone. After an error
/// nothing but the destructor may be called. Throws Error: usage, resource. Not thread safe.
class EvolutionFile {
public:
    /// path: ends in .vtkhdf. Throws Error{usage} for other extensions.
    explicit EvolutionFile(const std::string& path, const SurfaceFileOptions& options = {});
    ~EvolutionFile();
    EvolutionFile(const EvolutionFile&) = delete;
    EvolutionFile& operator=(const EvolutionFile&) = delete;

    /// The next step; its value is the calibrated isovalue, and values ascend: readers search in them. Positions are float64. Cost:
    /// O(surface). Throws Error{usage} for a value that is not above the one before, for an empty surface (VTK finds a step by counting
    /// cells), and for one that has another space, unit, interpolant or polarity than the first, or other arrays.
    void add(const Surface& surface);
    [[nodiscard]] std::int64_t steps() const;
    /// Writes what follows the last step, syncs the file and gives it its name. Throws Error{usage} when there is no step.
    void commit();

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas
