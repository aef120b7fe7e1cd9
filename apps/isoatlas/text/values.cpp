#include "text/values.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <isoatlas/output.h>
#include <isoatlas/units.h>

#include "options/words.h"

namespace isoatlas::cli {
namespace {

std::string seven_digits(double value) {
    const std::string text = fmt::format("{:.7g}", value);
    return text == "-0" ? "0" : text;
}

}  // namespace

std::string Scale::text(double stored) const {
    if (std::isinf(stored)) return "never";
    if (!info_.calibration.is_linear_identity()) return seven_digits(info_.calibration.reported(stored));
    const double value = info_.calibration.of_file(stored);
    if (info_.type == ValueType::f32 && value == static_cast<double>(static_cast<float>(value)))
        return fmt::format("{}", static_cast<float>(value) + 0.0F);
    return fmt::format("{}", value + 0.0);
}

std::string Scale::brief(double stored) const {
    const std::string exact = text(stored);
    return exact.size() <= 10 ? exact : seven_digits(info_.calibration.reported(stored));
}

std::string Scale::text_within(double stored, double low, double high) const {
    for (int digits = 7; digits < 17; ++digits) {
        double rounded = 0;
        if (!read_number(fmt::format("{:.{}g}", reported(stored), digits), rounded)) continue;  // the largest may be rounded beyond all
        const double back = this->stored(rounded);
        if (back > low && back <= high) return fmt::format("{}", rounded);
    }
    return fmt::format("{}", reported(stored));
}

std::string count_text(std::int64_t count) {
    std::string text = fmt::format("{}", count);
    const std::size_t first = count < 0 ? 1 : 0;
    for (std::size_t i = text.size(); i > first + 3; i -= 3) text.insert(i - 3, ",");
    return text;
}

std::string bytes_text(double bytes) {
    const char* units[] = {"B", "kB", "MB", "GB", "TB", "PB", "EB"};
    int unit = 0;
    while (bytes >= 999.5 && unit < 6) {
        bytes /= 1000;
        ++unit;
    }
    return unit == 0 || bytes >= 99.5 ? fmt::format("{:.0f} {}", bytes, units[unit]) : fmt::format("{:.2g} {}", bytes, units[unit]);
}

std::string seconds_text(double seconds) {
    if (seconds < 1) return "less than a second";
    if (seconds < 90) return fmt::format("about {:.0f} s", seconds);
    if (seconds < 5400) return fmt::format("about {:.0f} min", seconds / 60);
    return fmt::format("about {:.0f} h", seconds / 3600);
}

std::string counted(std::int64_t count, const std::string& noun, const std::string& plural) {
    const std::string& many = plural.empty() ? noun + "s" : plural;
    return count_text(count) + " " + (count == 1 ? noun : many);
}

std::string interpolant_text(const VolumeInfo& info, Interpolant interpolant, double tunnel_height) {
    return "interpolant " + describe(interpolant, info.calibration.reported_difference(tunnel_height));
}

std::string polarities_text(PolarityChoice polarities) {
    if (polarities == PolarityChoice::high) return "";
    return polarities == PolarityChoice::low ? ", objects of low values" : ", objects of high and of low values";
}

std::string plain_measure_unit(const VolumeInfo& info) { return measure_unit_name(info.geometry, info.extent.rank); }

std::string in_unit(const VolumeInfo& info) { return info.value_unit.empty() ? "" : " [" + info.value_unit + "]"; }

MeasureUnit measure_unit(const VolumeInfo& info, double largest) {
    if (info.extent.rank == 3 && info.geometry.unit == "mm") {
        if (largest >= 1e7) return {"dm³", 1e-6};
        if (largest >= 1e4) return {"cm³", 1e-3};
    }
    if (info.extent.rank == 2 && info.geometry.unit == "mm" && largest >= 1e4) return {"cm²", 1e-2};
    return {plain_measure_unit(info), 1};
}

std::string extent_text(const Extent& extent) {
    std::string text = fmt::format("{} x {}", extent.size[0], extent.size[1]);
    if (extent.rank == 3) text += fmt::format(" x {}", extent.size[2]);
    return text;
}

}  // namespace isoatlas::cli
