// Slices of one group as a volume: sorted along their normal, with time steps where places repeat; gaps and doubled slices are refused.
#pragma once

#include <string>
#include <vector>

#include "formats/volume/dicom_slices.h"

namespace isoatlas {

/// The slices of each time step, each sorted by place; all steps have as many.
struct DicomStack {
    std::vector<std::vector<DicomSlice>> steps;
    std::vector<double> times;  ///< empty: not known
    std::string time_unit;
    std::vector<std::string> notes;
};

/// Throws Error{input} with places in mm where slices are doubled without a difference that makes them time steps.
[[nodiscard]] DicomStack dicom_stack(const std::string& path, const DicomGroup& group, const std::vector<DicomFile>& files);

/// Where the slices of one step lie; rank 2 for a single one. Throws Error{input} with places in mm where slices are missing, or do not lie
/// on a line.
[[nodiscard]] Geometry dicom_geometry(const std::string& path, const std::vector<DicomSlice>& slices, std::vector<std::string>& notes);

}  // namespace isoatlas
