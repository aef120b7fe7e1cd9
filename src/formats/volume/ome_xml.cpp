#include "formats/volume/ome_xml.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>

#include "formats/common/length_unit.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "isoatlas/units.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxXml = std::size_t{64} << 20;
constexpr std::int64_t kMaxSize = std::int64_t{1} << 31;
constexpr std::size_t kFirstText = 4096;

std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node child_of(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node child : node.children()) {
        if (local_name(child) == name) return child;
    }
    return {};
}

class OmeParser {
public:
    OmeParser(const std::string& path, const std::string& own_name, const std::string& own_uuid)
        : path_(path), own_name_(own_name), own_uuid_(own_uuid) {}

    OmeXml parse(std::string_view text) {
        if (text.size() > kMaxXml) bad_field(path_, "OME-XML", "is larger than 64 MiB", "a description of images");
        pugi::xml_document document;
        const pugi::xml_parse_result result =
            document.load_buffer(text.data(), text.size(), pugi::parse_minimal | pugi::parse_escapes | pugi::parse_trim_pcdata);
        if (!result)
            bad_field(path_, "OME-XML, byte " + std::to_string(result.offset), std::string("is not sound: ") + result.description(), "XML");
        const pugi::xml_node root = document.document_element();
        OmeXml xml{.images = {}, .metadata_file = {}, .uuid = root.attribute("UUID").value()};
        if (own_uuid_.empty()) own_uuid_ = xml.uuid;
        if (const pugi::xml_node elsewhere = child_of(root, "BinaryOnly")) {
            xml.metadata_file = elsewhere.attribute("MetadataFile").value();
            if (xml.metadata_file.empty()) bad_field(path_, "OME-XML, BinaryOnly", "names no file", "MetadataFile");
            return xml;
        }
        for (const pugi::xml_node image : root.children()) {
            if (local_name(image) != "Image") continue;
            if (const pugi::xml_node pixels = child_of(image, "Pixels")) xml.images.push_back(image_of(image, pixels));
        }
        if (xml.images.empty()) bad_field(path_, "OME-XML", "describes no image", "an Image with Pixels");
        return xml;
    }

private:
    /// nullopt-like: `missing` where there is no attribute of this name.
    std::int64_t whole(const pugi::xml_node& node, const char* name, std::int64_t smallest, std::int64_t missing) const {
        const pugi::xml_attribute attribute = node.attribute(name);
        if (!attribute) return missing;
        const std::optional<std::int64_t> value = parse_integer(trim(attribute.value()));
        if (!value || *value < smallest || *value > kMaxSize) {
            bad_field(path_, "OME-XML, " + std::string(local_name(node)) + ", " + name, "is " + in_quotes(attribute.value()),
                      "a whole number from " + std::to_string(smallest));
        }
        return *value;
    }

    static double positive(const pugi::xml_attribute& attribute) {
        const double value = parse_number(trim(attribute.value())).value_or(0);
        return std::isfinite(value) && value > 0 ? value : 0;
    }

    OmeImage image_of(const pugi::xml_node& node, const pugi::xml_node& pixels) {
        OmeImage image;
        image.name = node.attribute("Name").value();
        image.width = whole(pixels, "SizeX", 1, 0), image.height = whole(pixels, "SizeY", 1, 0);
        image.slices = whole(pixels, "SizeZ", 1, 1), image.channels = whole(pixels, "SizeC", 1, 1),
        image.times = whole(pixels, "SizeT", 1, 1);
        if (image.slices > std::numeric_limits<std::int64_t>::max() / kMaxSize / image.times / 2 || image.channels > kMaxSize / image.times)
            bad_field(path_, "OME-XML, Pixels", "its sizes do not fit in 63 bits", "the sizes of the image");
        set_order(pixels, image);
        for (const pugi::xml_node channel : pixels.children()) {
            if (local_name(channel) != "Channel") continue;
            if (image.channel_names.empty()) image.samples = whole(channel, "SamplesPerPixel", 1, 1);
            image.channel_names.emplace_back(channel.attribute("Name").value());
        }
        if (image.channels % image.samples != 0) image.samples = 1;
        set_spacing(pixels, image);
        image.time_increment = positive(pixels.attribute("TimeIncrement"));
        const pugi::xml_attribute time_unit = pixels.attribute("TimeIncrementUnit");
        image.time_unit = time_unit ? time_unit.value() : "s";  // the default of the schema
        for (const pugi::xml_node data : pixels.children()) {
            if (local_name(data) == "TiffData") image.pages.push_back(pages_of(data));
        }
        return image;
    }

    void set_order(const pugi::xml_node& pixels, OmeImage& image) const {
        image.order = pixels.attribute("DimensionOrder").value();
        std::string sorted = image.order;
        std::ranges::sort(sorted);
        if (sorted != "CTXYZ" || !image.order.starts_with("XY"))
            bad_field(path_, "OME-XML, DimensionOrder", "is " + in_quotes(image.order), "XYZCT or the like");
    }

    /// Lengths in the unit of x; without one it is the default of the schema, and a unit that is no length gives ratios alone.
    static void set_spacing(const pugi::xml_node& pixels, OmeImage& image) {
        constexpr std::array<std::pair<const char*, const char*>, 3> kAxes = {
            {{"PhysicalSizeX", "PhysicalSizeXUnit"}, {"PhysicalSizeY", "PhysicalSizeYUnit"}, {"PhysicalSizeZ", "PhysicalSizeZUnit"}}};
        for (std::size_t a = 0; a < 3; ++a) {
            image.spacing[a] = positive(pixels.attribute(kAxes[a].first));
            const pugi::xml_attribute given = pixels.attribute(kAxes[a].second);
            const std::string unit = unit_name(given ? given.value() : "um");
            if (a == 0) image.unit = unit == "reference frame" ? "" : unit;
            const std::optional<double> metres = metres_in(unit), of_x = metres_in(image.unit);
            if (a > 0 && metres && of_x && *metres != *of_x) image.spacing[a] *= *metres / *of_x;
        }
        if (image.spacing[0] <= 0) image.unit.clear();
    }

    OmePages pages_of(const pugi::xml_node& data) const {
        OmePages pages;
        const bool has_first = static_cast<bool>(data.attribute("IFD"));
        pages.first = whole(data, "IFD", 0, 0);
        pages.count = whole(data, "PlaneCount", 0, has_first ? 1 : 0);
        pages.z = whole(data, "FirstZ", 0, 0), pages.channel = whole(data, "FirstC", 0, 0), pages.time = whole(data, "FirstT", 0, 0);
        const pugi::xml_node uuid = child_of(data, "UUID");
        if (!uuid) return pages;
        const std::string name = uuid.attribute("FileName").value(), id = uuid.child_value();
        const bool is_own = (!own_uuid_.empty() && id == own_uuid_) || (!name.empty() && name == own_name_);
        if (is_own) return pages;
        if (name.empty()) bad_field(path_, "OME-XML, UUID", "names no file and is not that of this file", "FileName");
        pages.file = name;
        return pages;
    }

    std::string path_, own_name_, own_uuid_;
};

}  // namespace

std::int64_t OmeImage::plane(const std::array<std::int64_t, 3>& at) const {
    std::int64_t number = 0, step = 1;
    for (std::size_t i = 2; i < order.size(); ++i) {
        const std::size_t axis = order[i] == 'Z' ? 0 : order[i] == 'C' ? 1 : 2;
        number += at[axis] * step;
        step *= axis == 0 ? slices : axis == 1 ? plane_channels() : times;
    }
    return number;
}

std::array<std::int64_t, 3> OmeImage::place(std::int64_t plane) const {
    std::array<std::int64_t, 3> at{};
    for (std::size_t i = 2; i < order.size(); ++i) {
        const std::size_t axis = order[i] == 'Z' ? 0 : order[i] == 'C' ? 1 : 2;
        const std::int64_t size = axis == 0 ? slices : axis == 1 ? plane_channels() : times;
        at[axis] = plane % size;
        plane /= size;
    }
    return at;
}

bool looks_like_ome(std::string_view text) {
    const std::string_view start = trim(text.substr(0, kFirstText));
    return start.starts_with("<") && (start.find("<OME") != std::string_view::npos || start.find(":OME") != std::string_view::npos);
}

OmeXml parse_ome_xml(const std::string& path, std::string_view text, const std::string& own_name, const std::string& own_uuid) {
    return OmeParser(path, own_name, own_uuid).parse(text);
}

}  // namespace isoatlas
