#include "formats/volume/tiff_description.h"

#include <cmath>
#include <pugixml.hpp>

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
std::string unit_name(std::string_view word) {
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
    if (key == "unit") description.unit = unit_name(value);
    if (key == "vunit") description.value_unit = std::string(trim(value));
    if (key == "cf") straight_line = trim(value) == "0";
    if (key == "c0") description.calibration.intercept = parse_number(trim(value)).value_or(0);
    if (key == "c1") description.calibration.slope = parse_number(trim(value)).value_or(1);
}

/// Lines "key=value"; reported value = c0 + c1 * stored when the calibration function cf is 0 (straight line).
TiffDescription parse_imagej(std::string_view text) {
    TiffDescription description;
    description.kind = TiffDescription::Kind::imagej;
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

/// The first Pixels element of an OME-XML text (namespace prefixes allowed).
pugi::xml_node find_pixels(const pugi::xml_node& root) {
    for (const pugi::xml_node image : root.children()) {
        for (const pugi::xml_node pixels : image.children()) {
            const std::string_view name = pixels.name();
            if (name == "Pixels" || name.ends_with(":Pixels")) return pixels;
        }
    }
    return {};
}

TiffDescription parse_ome(std::string_view text) {
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size(), pugi::parse_minimal | pugi::parse_escapes)) return {};
    const pugi::xml_node pixels = find_pixels(document.document_element());
    if (!pixels) return {};
    TiffDescription description;
    description.kind = TiffDescription::Kind::ome;
    description.channels = count_or(pixels.attribute("SizeC").value(), 1);
    description.slices = count_or(pixels.attribute("SizeZ").value(), 1);
    description.frames = count_or(pixels.attribute("SizeT").value(), 1);
    const std::string_view order = pixels.attribute("DimensionOrder").value();
    description.frames_are_fastest = order.find('T') < order.find('Z');
    static constexpr const char* kSize[] = {"PhysicalSizeX", "PhysicalSizeY", "PhysicalSizeZ"};
    for (int axis = 0; axis < 3; ++axis) description.spacing[axis] = positive_or_zero(pixels.attribute(kSize[axis]).value());
    if (description.spacing[0] > 0) {
        const pugi::xml_attribute unit = pixels.attribute("PhysicalSizeXUnit");
        description.unit = unit ? unit_name(unit.value()) : "um";  // the default of the OME schema
    }
    return description;
}

}  // namespace

TiffDescription parse_tiff_description(std::string_view text) {
    if (text.starts_with("ImageJ=")) return parse_imagej(text);
    const std::string_view start = trim(text.substr(0, 4096));
    if (start.starts_with("<") && start.find("OME") != std::string_view::npos) return parse_ome(text);
    return {};
}

}  // namespace isoatlas
