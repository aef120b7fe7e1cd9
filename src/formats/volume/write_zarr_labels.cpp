// Labels as a group of OME-Zarr 0.4.
#include <algorithm>
#include <optional>
#include <utility>

#include "base/atomic_file.h"
#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/label_samples.h"
#include "formats/volume/write_zarr.h"
#include "formats/volume/zarr_info.h"
#include "formats/volume/zarr_levels.h"
#include "formats/zarr/hierarchy.h"

namespace isoatlas {
namespace {

[[noreturn]] void other_folder(const std::string& path, const std::string& what) {
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = what,
                                   .expected = "an OME-Zarr of version 0.4 with the image that was labelled, or a new name",
                                   .next = "choose another name for the labels"});
}

/// Throws where labels of this extent do not belong into the hierarchy that is there.
void check_image(KeyStore& store, const std::string& path, const Extent& extent) {
    const std::optional<ZarrNode> root = read_node(store, "");
    if (!root || root->array) other_folder(path, "is there already and is no OME-Zarr");
    if (root->version != 2) other_folder(path, "is an OME-Zarr of version 0.5");
    const Json& ome = ome_of(root->attributes);
    const std::vector<std::string> levels = level_paths("", ome);
    if (levels.empty()) return;  // labels alone
    const std::optional<ZarrNode> finest = read_node(store, levels[0]);
    if (!finest || !finest->array) other_folder(path, "is an OME-Zarr without its image");
    const Multiscale image = read_multiscale(store, "", ome, finest->array->rank());
    if (size_of_level(*finest->array, image.axes) != extent.size) other_folder(path, "is an OME-Zarr with an image of other sizes");
}

Json image_label(std::span<const Segment> segments, bool has_image) {
    Json colours = Json::array(), properties = Json::array();
    for (const Segment& segment : segments) {
        const auto [red, green, blue] = segment.colour;
        colours.push_back({{"label-value", segment.number}, {"rgba", {red, green, blue, 255}}});
        Json property{{"label-value", segment.number}, {"isovalue", segment.isovalue}, {"voxels", segment.voxels}};
        property["name"] = segment.name.empty() ? "object " + std::to_string(segment.number) : segment.name;
        if (segment.polarity == Polarity::low) property["polarity"] = "low";
        properties.push_back(property);
    }
    Json label{{"version", "0.4"}};
    if (!segments.empty()) label["colors"] = colours, label["properties"] = properties;
    if (has_image) label["source"] = {{"image", "../../"}};
    return label;
}

/// The samples of labels in the smallest type.
std::vector<std::byte> label_bytes(std::span<const std::uint32_t> labels, ValueType type) {
    std::vector<std::byte> bytes;
    bytes.reserve(labels.size() * size_of(type));
    label_feed(labels, type)([&](std::span<const std::byte> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); });
    return bytes;
}

std::string text_of(const Json& json) { return json.dump(1, ' ', true, Json::error_handler_t::replace); }

/// Writes the group of labels below `prefix` ("" or "labels/NAME/").
void write_label_group(FolderOutput& folder, const std::string& prefix, const std::string& name, std::span<const std::uint32_t> labels,
                       std::span<const Segment> segments, const VolumeInfo& info, bool has_image) {
    VolumeInfo header = info;
    header.type = label_type(labels);
    folder.put(prefix + ".zgroup", kZarrGroup);
    const std::vector<std::byte> samples = label_bytes(labels, header.type);
    const std::string path = prefix.empty() ? "" : prefix.substr(0, prefix.size() - 1);
    Json attributes{{"multiscales", write_zarr_levels(folder, path, name, header, samples, Coarsening::first)}};
    attributes["image-label"] = image_label(segments, has_image);
    header.calibration = {}, header.value_unit.clear();
    attributes["isoatlas"] = zarr_remainder(header);
    folder.put(prefix + ".zattrs", text_of(attributes));
}

std::string free_name(const std::vector<std::string>& taken, const std::string& path, const std::string& wanted) {
    std::string name = wanted;
    const auto is_taken = [&] { return std::ranges::find(taken, name) != taken.end() || is_directory(path + "/labels/" + name); };
    for (int number = 2; is_taken(); ++number) name = wanted + "-" + std::to_string(number);
    return name;
}

/// Adds to the hierarchy that is there: the group appears whole, then the list of labels names it.
std::vector<std::string> add_labels(const std::string& path, const std::string& wanted, std::span<const std::uint32_t> labels,
                                    std::span<const Segment> segments, const VolumeInfo& info) {
    constexpr std::size_t kMostLabelSets = 10000;
    const std::unique_ptr<KeyStore> store = open_folder_store(path, false);
    check_image(*store, path, info.extent);
    std::vector<std::string> names = labels_of(*store, "", kMostLabelSets), warnings;
    const std::string name = free_name(names, path, wanted);
    if (name != wanted)
        warnings.push_back("the labels " + in_quotes(wanted) + " are there already and stay: the new ones are " + in_quotes(name));
    if (file_exists(path + "/.zmetadata"))
        warnings.emplace_back("the consolidated metadata (.zmetadata) do not know the new labels: consolidate them again");
    if (is_directory(path + "/labels")) {
        FolderOutput folder(path + "/labels/" + name);
        write_label_group(folder, "", name, labels, segments, info, true);
        folder.commit();
        Json attributes = read_json(*store, "labels/.zattrs").value_or(Json::object());
        names.push_back(name);
        attributes["labels"] = names;
        AtomicFile list(path + "/labels/.zattrs");
        list.write(text_of(attributes));
        list.commit();
        return warnings;
    }
    FolderOutput folder(path + "/labels");
    folder.put(".zgroup", kZarrGroup);
    folder.put(".zattrs", text_of({{"labels", Json::array({name})}}));
    write_label_group(folder, name + "/", name, labels, segments, info, true);
    folder.commit();
    return warnings;
}

}  // namespace

std::vector<std::string> write_zarr_labels(const std::string& path, const std::string& name, std::span<const std::uint32_t> labels,
                                           std::span<const Segment> segments, const VolumeInfo& info) {
    if (is_directory(path)) return add_labels(path, name, labels, segments, info);
    FolderOutput folder(path);
    folder.put(".zgroup", kZarrGroup);
    folder.put("labels/.zgroup", kZarrGroup);
    folder.put("labels/.zattrs", text_of({{"labels", Json::array({name})}}));
    write_label_group(folder, "labels/" + name + "/", name, labels, segments, info, false);
    folder.commit();
    return {};
}

}  // namespace isoatlas
