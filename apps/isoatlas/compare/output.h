// A comparison as text, JSON, CSV, and as a page.
#pragma once

#include <string>
#include <vector>

#include "compare/comparison.h"
#include "compare/pictures.h"
#include "compare/volume_pictures.h"
#include "text/document.h"

namespace isoatlas::cli {

class Terminal;

void print_text(Terminal& terminal, const Comparison& found);
/// docs/schema/compare.schema.json
[[nodiscard]] Json json_of(const Comparison& found, const VolumePictures& volume);
/// A line for each surface and each query; what does not apply is empty.
[[nodiscard]] std::string csv_of(const Comparison& found);

/// What a page needs beside the numbers.
struct ComparePage {
    std::vector<MethodPicture> pictures{};
    VolumePictures volume{};
    std::optional<SampleBox> pictured{};  ///< none: the whole volume
    std::string command{};                ///< that makes the page
};
/// One HTML document that loads nothing from elsewhere and runs no scripts.
[[nodiscard]] std::string html_of(const Comparison& found, const ComparePage& page);

/// A quantity that grows: of each search, over the number of active cells or over that of all cells.
struct Growth {
    std::string title, x_name, y_name;
    struct Line {
        std::string name;
        int number;  ///< of the search: its colour and marker in all plots
        std::vector<std::array<double, 2>> points;
        std::optional<double> exponent;
    };
    std::vector<Line> lines;
};
/// Empty without studies.
[[nodiscard]] std::vector<Growth> growth_of(const Comparison& found);

/// "12.3": in three digits.
[[nodiscard]] std::string milliseconds(double seconds);
/// "0.0123"; "-" where nothing was measured.
[[nodiscard]] std::string distance_text(const SurfaceDistance& distance, double voxels);
/// Which part of the volume the surfaces are of, and why; there is one.
[[nodiscard]] std::string part_text(const Comparison& found);
/// "1.4 GB"
[[nodiscard]] std::string size_text(std::int64_t bytes);

}  // namespace isoatlas::cli
