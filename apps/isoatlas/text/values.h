// Formats values for reading: calibrated sample values, sizes in physical units, bytes, counts.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <isoatlas/analysis.h>
#include <isoatlas/isovalue.h>
#include <isoatlas/polarity.h>

namespace isoatlas::cli {

/// Converts between the stored values of a file and calibrated ones.
class Scale {
public:
    explicit Scale(const VolumeInfo& info) { info_.calibration = info.calibration, info_.type = info.type; }

    /// The stored isovalue of a typed one: the sample value that text() prints in this form, if there is one.
    [[nodiscard]] double stored(double reported) const { return stored_isovalue(info_, reported); }
    [[nodiscard]] double reported(double stored) const { return info_.calibration.reported(stored); }
    /// Two ends of an interval of stored values in the order of the values they stand for.
    [[nodiscard]] std::array<double, 2> ends(double low, double high) const {
        return is_low() ? std::array{high, low} : std::array{low, high};
    }
    /// Words for the way that isovalues take from where an object appears, and its end.
    [[nodiscard]] std::string way() const { return is_low() ? "up to" : "down to"; }
    [[nodiscard]] std::string last() const { return is_low() ? "top" : "bottom"; }
    [[nodiscard]] bool is_low() const { return polarity_of(info_) == Polarity::low; }

    /// Shortest text that reads back as this value; infinities: "never".
    [[nodiscard]] std::string text(double stored) const;
    /// For tables: as text(), but never more than about nine characters.
    [[nodiscard]] std::string brief(double stored) const;
    /// Seven digits, or as many more as needed to stay in (low, high], where the topology is constant.
    [[nodiscard]] std::string text_within(double stored, double low, double high) const;

private:
    VolumeInfo info_;  ///< calibration and type
};

/// "16,777,216"
[[nodiscard]] std::string count_text(std::int64_t count);
/// "1.4 GB"
[[nodiscard]] std::string bytes_text(double bytes);
/// "about 40 s", "about 3 min"
[[nodiscard]] std::string seconds_text(double seconds);
/// "1 object", "2 objects"; irregular plurals are given
[[nodiscard]] std::string counted(std::int64_t count, const std::string& noun, const std::string& plural = "");

/// "interpolant trilinear, tunnel height 0.25"; the height is given in stored values
[[nodiscard]] std::string interpolant_text(const VolumeInfo& info, Interpolant interpolant, double tunnel_height);

/// "", ", objects of low values", ", objects of high and of low values"
[[nodiscard]] std::string polarities_text(PolarityChoice polarities);

/// The unit of volumes (areas in 2D) for numbers up to `largest`: mm³, cm³, dm³, ... Multiply values by the factor.
struct MeasureUnit {
    std::string name;
    double factor = 1;
};
[[nodiscard]] MeasureUnit measure_unit(const VolumeInfo& info, double largest);
/// The unit of volumes as the file has it: "mm³"; without a unit "voxels", or "units³" when there is a spacing.
[[nodiscard]] std::string plain_measure_unit(const VolumeInfo& info);

/// " [HU]", or "" when the unit of the values is not known.
[[nodiscard]] std::string in_unit(const VolumeInfo& info);

/// "512 x 512 x 420"
[[nodiscard]] std::string extent_text(const Extent& extent);

}  // namespace isoatlas::cli
