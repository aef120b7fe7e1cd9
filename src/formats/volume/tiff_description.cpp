#include "formats/volume/tiff_description.h"

#include <algorithm>
#include <cmath>

#include "formats/common/text.h"

namespace isoatlas {

namespace {

constexpr std::int64_t kMaxPages = std::int64_t{1} << 32;

double positive_or_zero(std::string_view word) {
    const double value = parse_number(trim(word)).value_or(0);
    return std::isfinite(value) && value > 0 ? value : 0;
}

std::int64_t count_or(std::string_view word, std::int64_t missing) {
    const std::int64_t value = parse_integer(trim(word)).value_or(0);
    return value >= 1 && value <= kMaxPages ? value : missing;
}

/// The short ASCII name of a length unit; inches are left to the caller.
std::string tiff_unit_name(std::string_view word) {
    std::string unit = lower(trim(word));
    for (const std::string_view micro :
         {"um", "micron", "microns", "micrometer", "\\u00b5m", "\\u03bcm", "\xc2\xb5m", "\xce\xbcm", "\xb5m"}) {
        if (unit == micro) return "um";
    }
    for (const std::string_view name : {"m", "cm", "mm", "nm", "pm"}) {
        if (unit == name) return unit;
    }
    if (unit == "millimeter") return "mm";
    if (unit == "nanometer") return "nm";
    if (unit == "\xc3\xa5" || unit == "\xc3\x85" || unit == "angstrom") return "angstrom";
    if (unit == "inch" || unit == "inches") return "inch";
    return "";  // pixels and anything unknown
}

void take_imagej_line(std::string_view key, std::string_view value, TiffDescription& description, bool& straight_line) {
    if (key == "images") description.images = count_or(value, 0);
    if (key == "channels") description.channels = count_or(value, 1);
    if (key == "slices") description.slices = count_or(value, 1);
    if (key == "frames") description.frames = count_or(value, 1);
    if (key == "spacing") description.spacing[2] = positive_or_zero(value);
    if (key == "unit") description.unit = tiff_unit_name(value);
    if (key == "finterval") description.frame_interval = positive_or_zero(value);
    if (key == "tunit") description.time_unit = std::string(trim(value));
    if (key == "vunit") description.value_unit = std::string(trim(value));
    if (key == "cf") straight_line = trim(value) == "0";
    if (key == "c0") description.calibration.intercept = parse_number(trim(value)).value_or(0);
    if (key == "c1") description.calibration.slope = parse_number(trim(value)).value_or(1);
}

/// Lines "key=value"; reported value = c0 + c1 * stored when the calibration function cf is 0 (straight line).
TiffDescription parse_imagej(std::string_view text) {
    TiffDescription description;
    description.is_imagej = true;
    bool straight_line = false;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::size_t equals = line.find('=');
        if (equals != std::string_view::npos) {
            take_imagej_line(trim(line.substr(0, equals)), line.substr(equals + 1), description, straight_line);
        }
    }
    const Calibration& c = description.calibration;
    const bool usable = straight_line && std::isfinite(c.slope) && std::isfinite(c.intercept) && c.slope != 0;
    if (!usable) description.calibration = {};
    return description;
}

}  // namespace

TiffDescription parse_tiff_description(std::string_view text) {
    if (text.starts_with("ImageJ=")) return parse_imagej(text);
    return {};
}

}  // namespace isoatlas
