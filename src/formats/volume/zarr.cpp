// Zarr, versions 2 and 3, and OME-Zarr: https://zarr.dev, https://ngff.openmicroscopy.org
//
// AXIS ORDER. The last axis of an array in C order is x, as with .npy, unless the metadata name the axes.
#include "formats/volume/zarr.h"

#include <algorithm>
#include <filesystem>
#include <ranges>
#include <utility>

#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/choose.h"
#include "formats/volume/formats.h"
#include "formats/volume/zarr_info.h"
#include "formats/volume/zarr_samples.h"
#include "formats/zarr/hierarchy.h"
#include "formats/zarr/zarr_chunks.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMostChoices = 1000;

bool is_image_group(const ZarrNode& node) { return !node.array && find_member(ome_of(node.attributes), "multiscales") != nullptr; }

std::string without_slashes(std::string path) {
    while (path.starts_with('/')) path.erase(0, 1);
    while (path.ends_with('/')) path.pop_back();
    return path;
}

/// Chooses among what a group holds. base: what the words of the choices are relative to.
ZarrNode choose_in(KeyStore& store, const std::string& path, const ZarrNode& group, const std::string& base, const OpenOptions& options) {
    const std::vector<ZarrChoice> found = choices_in(store, group, kMostChoices);
    if (found.empty())
        bad_zarr(store, group.path, "the Zarr group holds no image and no array with 2 or more axes", "an array, or an image of OME-Zarr",
                 "name a folder that holds one");
    std::vector<ErrorChoice> choices;
    for (const ZarrChoice& choice : found)
        choices.push_back({.word = choice.path.substr(base.empty() ? 0 : base.size()), .about = choice.about});
    for (ErrorChoice& choice : choices) choice.word = "/" + without_slashes(choice.word);
    const std::size_t chosen = choose_dataset(path, options, choices);
    return *read_node(store, found[chosen].path);
}

/// The node that path and options name: an array, or a group that is an image.
ZarrNode find_volume(KeyStore& store, const std::string& path, const std::string& inside, const OpenOptions& options) {
    std::optional<ZarrNode> root = read_node(store, inside);
    if (!root) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .what = "holds no Zarr array and no Zarr group at its root",
                                             .expected = "zarr.json, .zarray or .zgroup",
                                             .next = "unpack the archive and give the file inside",
                                             .reason = Reason::foreign_format});
    }
    if (root->array) return *std::move(root);
    std::optional<ZarrNode> node = root;
    const std::string dataset = without_slashes(options.dataset.value_or(""));
    if (!dataset.empty()) {
        const std::string wanted = join_key(inside, dataset);
        node = is_sound_key(wanted) ? read_node(store, wanted) : std::nullopt;
        if (!node) return choose_in(store, path, *root, inside, options);  // one of its words, or an error that lists them
    }
    if (node->array || is_image_group(*node)) return *std::move(node);
    OpenOptions any = options;
    any.dataset.reset();
    return choose_in(store, path, *node, inside, any);
}

/// The image that an array is a level of, when the group that holds it, or one above, says so.
std::optional<ZarrImage> image_of_array(KeyStore& store, const ZarrArray& array) {
    constexpr int kFarthest = 3;
    std::string group = array.path;
    for (int i = 0; i < kFarthest && !group.empty(); ++i) {
        group = parent_of(group);
        const std::optional<ZarrNode> node = read_node(store, group);
        if (!node || !is_image_group(*node)) continue;
        const Json& ome = ome_of(node->attributes);
        const std::vector<std::string> paths = level_paths(group, ome);
        const auto level = std::ranges::find(paths, array.path);
        if (level == paths.end()) continue;
        return ZarrImage{.array = array,
                         .multiscale = read_multiscale(store, group, ome, array.rank()),
                         .level = static_cast<std::size_t>(level - paths.begin())};
    }
    return std::nullopt;
}

std::optional<ZarrArray> array_at(KeyStore& store, const std::string& path) {
    std::optional<ZarrNode> node = read_node(store, path);
    return node ? std::move(node->array) : std::nullopt;
}

/// The chosen level of an image, and the sizes of the others up to the first that is missing.
ZarrImage image_of_group(KeyStore& store, const std::string& path, const ZarrNode& group, const OpenOptions& options) {
    const Json& ome = ome_of(group.attributes);
    const std::vector<std::string> paths = level_paths(group.path, ome);
    std::vector<ZarrArray> arrays;
    for (const std::string& level : paths) {
        std::optional<ZarrArray> array = array_at(store, level);
        if (!array || (!arrays.empty() && array->rank() != arrays[0].rank())) break;
        arrays.push_back(*std::move(array));
    }
    if (arrays.empty()) {
        const std::string first = paths.empty() ? group.path : paths[0];
        bad_zarr(store, first, "the array of the image is missing", "an array for each level of the image");
    }
    ZarrImage image;
    image.multiscale = read_multiscale(store, group.path, ome, arrays[0].rank());
    image.level = static_cast<std::size_t>(choose_level(path, options, std::ssize(arrays)));
    for (const ZarrArray& array : arrays) image.levels.push_back(size_of_level(array, image.multiscale->axes));
    image.array = std::move(arrays[image.level]);
    return image;
}

void add_notes(KeyStore& store, const ZarrNode& node, const ZarrImage& image, const std::string& inside, VolumeInfo& info) {
    constexpr std::size_t kMostLabels = 20;
    const std::int64_t most_asked = store.is_remote() ? 8 : 1000;
    if (const auto& shards = image.array.shards) {
        std::string size;
        for (const auto samples : std::views::reverse(shards->size)) size += (size.empty() ? "" : " x ") + std::to_string(samples);
        info.notes.push_back("shards of " + size);
    }
    if (!node.array) {
        std::string labels;
        for (const std::string& name : labels_of(store, node.path, kMostLabels)) {
            const std::string whole = join_key(join_key(node.path, "labels"), name);
            labels += (labels.empty() ? "/" : ", /") + without_slashes(whole.substr(inside.size()));
        }
        if (!labels.empty()) info.notes.push_back("labels of the image are datasets of their own: " + labels);
    }
    const StoredSize size = stored_size(store, image.array, most_asked);
    info.file_bytes = size.bytes;
    if (!size.is_exact) info.notes.push_back("the size on disk is estimated from " + std::to_string(most_asked) + " chunks");
}

bool has_marks(const std::filesystem::path& folder) {
    if (is_address(folder.string())) return is_directory(folder.string());  // a server knows no other folders
    return std::ranges::any_of(kZarrMarks, [&](const char* mark) { return file_exists((folder / mark).string()); });
}

}  // namespace

std::unique_ptr<VolumeReader> open_zarr_store(std::shared_ptr<KeyStore> store, const std::string& path, const std::string& inside,
                                              const OpenOptions& options) {
    const ZarrNode node = find_volume(*store, path, inside, options);
    ZarrImage image;
    if (node.array) {
        image = image_of_array(*store, *node.array).value_or(ZarrImage{.array = *node.array});
    } else {
        image = image_of_group(*store, path, node, options);
    }
    const ZarrAxes axes = axes_of(*store, image);
    VolumeInfo info = zarr_info(*store, path, image, axes, options);
    info.volumes.has_datasets = !node.array || node.path != inside;
    add_notes(*store, node, image, inside, info);
    return make_zarr_reader(std::move(info), std::move(store), std::move(image.array), axes);
}

bool is_zarr_folder(const std::string& path) { return has_marks(path); }

std::unique_ptr<VolumeReader> open_zarr_folder(const std::string& path, const OpenOptions& options) {
    constexpr int kFarthest = 16;
    std::string whole = file_system().resolved(path);
    while (is_address(whole) && whole.ends_with('/')) whole.pop_back();
    std::filesystem::path root = whole;
    std::string inside;
    for (int i = 0; i < kFarthest && root.has_parent_path() && root != root.parent_path() && has_marks(root.parent_path()); ++i) {
        inside = join_key(root.filename().string(), inside);
        if (inside.ends_with('/')) inside.pop_back();
        root = root.parent_path();
    }
    return open_zarr_store(open_folder_store(inside.empty() && !is_address(path) ? path : root.string(), options.follow_links), path,
                           inside, options);
}

bool looks_like_zip(FirstBytes first, const std::string& path) {
    constexpr std::array<std::string_view, 2> kZipMagic{"PK\x03\x04", "PK\x05\x06"};
    if (first.size() < 4 || ends_with_ignoring_case(path, ".npz")) return false;
    const std::string_view begin(reinterpret_cast<const char*>(first.data()), 4);
    return begin == kZipMagic[0] || begin == kZipMagic[1];
}

std::unique_ptr<VolumeReader> open_zarr_zip(const std::string& path, const OpenOptions& options) {
    return open_zarr_store(open_zip_store(path), path, "", options);
}

}  // namespace isoatlas
