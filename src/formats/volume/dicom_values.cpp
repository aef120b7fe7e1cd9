// Values of DICOM elements as texts and numbers; names of transfer syntaxes.
#include <algorithm>
#include <cmath>

#include "formats/common/text.h"
#include "formats/volume/dicom_header.h"

namespace isoatlas {

const std::string* DicomValues::find(DicomTag tag) const {
    const auto found = std::ranges::find(values_, tag, &std::pair<DicomTag, std::string>::first);
    return found == values_.end() ? nullptr : &found->second;
}

std::string DicomValues::text(DicomTag tag) const {
    const std::string* found = find(tag);
    return found == nullptr ? "" : *found;
}

std::optional<std::vector<double>> DicomValues::numbers(DicomTag tag) const {
    const std::string* found = find(tag);
    if (found == nullptr || found->empty()) return std::nullopt;
    std::vector<double> numbers;
    for (std::string_view rest = *found;;) {
        const std::size_t end = rest.find('\\');
        std::string_view word = trim(rest.substr(0, end));
        if (word.starts_with('+')) word.remove_prefix(1);
        const std::optional<double> number = parse_number(word);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.push_back(*number);
        if (end == std::string_view::npos) return numbers;
        rest.remove_prefix(end + 1);
    }
}

std::optional<double> DicomValues::number(DicomTag tag) const {
    const std::optional<std::vector<double>> all = numbers(tag);
    return all ? std::optional(all->front()) : std::nullopt;
}

std::string name_of_syntax(const std::string& uid) {
    static constexpr std::pair<std::string_view, const char*> kNames[] = {{"1.2.840.10008.1.2", "implicit little endian"},
                                                                          {"1.2.840.10008.1.2.1", "explicit little endian"},
                                                                          {"1.2.840.10008.1.2.1.99", "deflate"},
                                                                          {"1.2.840.10008.1.2.2", "explicit big endian"},
                                                                          {"1.2.840.10008.1.2.4.50", "JPEG baseline"},
                                                                          {"1.2.840.10008.1.2.4.51", "JPEG extended"},
                                                                          {"1.2.840.10008.1.2.4.57", "JPEG lossless"},
                                                                          {"1.2.840.10008.1.2.4.70", "JPEG lossless"},
                                                                          {"1.2.840.10008.1.2.4.80", "JPEG-LS lossless"},
                                                                          {"1.2.840.10008.1.2.4.81", "JPEG-LS"},
                                                                          {"1.2.840.10008.1.2.4.90", "JPEG 2000 lossless"},
                                                                          {"1.2.840.10008.1.2.4.91", "JPEG 2000"},
                                                                          {"1.2.840.10008.1.2.4.92", "JPEG 2000 part 2 lossless"},
                                                                          {"1.2.840.10008.1.2.4.93", "JPEG 2000 part 2"},
                                                                          {"1.2.840.10008.1.2.4.100", "MPEG-2"},
                                                                          {"1.2.840.10008.1.2.4.101", "MPEG-2"},
                                                                          {"1.2.840.10008.1.2.4.102", "MPEG-4"},
                                                                          {"1.2.840.10008.1.2.4.103", "MPEG-4"},
                                                                          {"1.2.840.10008.1.2.4.107", "HEVC"},
                                                                          {"1.2.840.10008.1.2.4.110", "JPEG XL lossless"},
                                                                          {"1.2.840.10008.1.2.4.112", "JPEG XL"},
                                                                          {"1.2.840.10008.1.2.4.201", "HTJ2K lossless"},
                                                                          {"1.2.840.10008.1.2.4.202", "HTJ2K lossless"},
                                                                          {"1.2.840.10008.1.2.4.203", "HTJ2K"},
                                                                          {"1.2.840.10008.1.2.5", "RLE"}};
    const auto found = std::ranges::find(kNames, uid, &std::pair<std::string_view, const char*>::first);
    return found == std::end(kNames) ? "transfer syntax " + in_quotes(uid) : found->second;
}

}  // namespace isoatlas
