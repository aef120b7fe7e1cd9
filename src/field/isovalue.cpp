#include "isoatlas/isovalue.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

namespace isoatlas {
namespace {

constexpr int kDigits = 7;  ///< of a calibrated value

template <class... Format>
std::string text_of(Format... format) {
    char digits[64];
    return {digits, std::to_chars(digits, digits + sizeof digits, format...).ptr};
}

/// The shortest decimal of a value of the file in reported units; info: without a mirror.
std::string decimal_of(const VolumeInfo& info, double stored) {
    if (!info.calibration.is_identity()) return text_of(info.calibration.reported(stored) + 0.0, std::chars_format::general, kDigits);
    const auto as_float = static_cast<float>(stored);
    if (info.type == ValueType::f32 && static_cast<double>(as_float) == stored) return text_of(as_float + 0.0F);
    return text_of(stored + 0.0);
}

double isovalue_of_file(const VolumeInfo& info, double reported) {
    const double exact = info.calibration.stored(reported);
    if (info.type == ValueType::f64 && info.calibration.is_identity()) return exact;
    const double sample = is_floating(info.type) ? static_cast<double>(static_cast<float>(exact)) : std::round(exact);
    return decimal_of(info, sample) == decimal_of(info, exact) ? sample : exact;
}

}  // namespace

double stored_isovalue(const VolumeInfo& info, double reported) {
    VolumeInfo file;
    file.type = info.type, file.calibration = info.calibration, file.calibration.mirror.reset();
    return info.calibration.of_samples(isovalue_of_file(file, reported));
}

}  // namespace isoatlas
