// The table of labels beside a label volume.
#pragma once

#include <string>
#include <string_view>

namespace isoatlas {

inline constexpr std::string_view kSegmentTableHeader = "number,name,red,green,blue,isovalue,voxels";  // of low values one more

/// "labels.nii.gz" -> "labels.csv".
[[nodiscard]] std::string segment_table_path(const std::string& path);

}  // namespace isoatlas
