#include "formats/zarr/hierarchy.h"

#include <algorithm>
#include <ranges>
#include <set>
#include <string_view>
#include <utility>

#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMostNames = 10000;

std::optional<ZarrNode> node_of_version_3(KeyStore& store, const std::string& path) {
    const std::string key = join_key(path, "zarr.json");
    const std::optional<Json> metadata = read_json(store, key, "consolidated_metadata");
    if (!metadata) return std::nullopt;
    const Json* version = find_member(*metadata, "zarr_format");
    if (version == nullptr || *version != 3) bad_zarr(store, in_key(key, "zarr_format"), "is not valid", "3");
    ZarrNode node{.path = path, .version = 3};
    const std::string type = text_member(*metadata, "node_type");
    if (type == "array") {
        node.array = array_of_version_3(store, path, *metadata);
    } else if (type != "group") {
        bad_zarr(store, in_key(key, "node_type"), "is not valid", "\"array\" or \"group\"");
    }
    if (const Json* attributes = find_member(*metadata, "attributes"); attributes != nullptr && attributes->is_object())
        node.attributes = *attributes;
    return node;
}

std::optional<ZarrNode> node_of_version_2(KeyStore& store, const std::string& path) {
    const std::optional<Json> metadata = read_json(store, join_key(path, ".zarray"));
    const bool is_group = !metadata && store.size(join_key(path, ".zgroup")).has_value();
    std::optional<Json> attributes = read_json(store, join_key(path, ".zattrs"));
    if (!metadata && !is_group && !attributes) return std::nullopt;
    ZarrNode node{.path = path};
    if (metadata) {
        node.array = array_of_version_2(store, path, *metadata, attributes.value_or(Json::object()));
    } else if (attributes) {
        node.attributes = *std::move(attributes);
    }
    return node;
}

bool is_image(const ZarrNode& node) { return !node.array && find_member(ome_of(node.attributes), "multiscales") != nullptr; }

/// Paths in a list of objects: {"wells": [{"path": "A/1"}, ...]}; what is no path is left out.
std::vector<std::string> paths_in(const Json* list, const char* name) {
    std::vector<std::string> paths;
    if (list == nullptr || !list->is_array()) return paths;
    for (const Json& entry : *list) {
        const std::string path = entry.is_string() ? entry.get<std::string>() : text_member(entry, name);
        if (is_sound_key(path)) paths.push_back(path);
    }
    return paths;
}

/// Keys of consolidated metadata, for stores that cannot list.
std::vector<std::string> consolidated_names(KeyStore& store, const ZarrNode& group) {
    std::vector<std::string> names;
    const std::string key = join_key(group.path, group.version == 3 ? "zarr.json" : ".zmetadata");
    const std::optional<Json> document = read_json(store, key);
    if (!document) return names;
    const Json* list = find_member(*document, group.version == 3 ? "consolidated_metadata" : "metadata");
    if (list != nullptr && group.version == 3) list = find_member(*list, "metadata");
    if (list == nullptr || !list->is_object()) return names;
    std::set<std::string> found;
    for (const auto& [path, value] : list->items()) {
        const std::size_t end = path.find('/');
        const bool is_child = group.version == 3 || end != std::string::npos;  // ".zattrs" is of the group itself
        if (is_child && is_sound_key(path)) found.insert(path.substr(0, end));
    }
    return {found.begin(), found.end()};
}

std::string about_array(const ZarrArray& array) {
    std::string text;
    for (const std::int64_t size : std::views::reverse(array.shape)) text += (text.empty() ? "" : " x ") + std::to_string(size);
    return text + " " + array.type.name();
}

/// Looks through a hierarchy, the images and arrays of a group before those of the groups in it.
class Search {
public:
    Search(KeyStore& store, std::size_t most) : store_(store), most_(most) {}

    void group(const ZarrNode& group, int depth) {
        const Json& ome = ome_of(group.attributes);
        if (const Json* plate = find_member(ome, "plate")) {
            for (const std::string& path : paths_in(find_member(*plate, "wells"), "path")) child(group, path, depth);
        } else if (const Json* well = find_member(ome, "well")) {
            for (const std::string& path : paths_in(find_member(*well, "images"), "path")) child(group, path, depth);
        } else if (const Json* labels = find_member(ome, "labels")) {
            for (const std::string& path : paths_in(labels, "path")) child(group, path, depth);
        } else {
            const std::optional<std::vector<std::string>> names = store_.list(group.path, kMostNames);
            for (const std::string& name : names ? *names : consolidated_names(store_, group)) child(group, name, depth);
        }
    }

    [[nodiscard]] std::vector<ZarrChoice> take() { return std::move(found_); }

private:
    void child(const ZarrNode& parent, const std::string& name, int depth) {
        constexpr int kDeepest = 6, kMostAsked = 20000;
        if (found_.size() >= most_ || ++asked_ > kMostAsked || name.starts_with('.') || name == "zarr.json" || !is_sound_key(name)) return;
        const std::string path = join_key(parent.path, name);
        std::optional<ZarrNode> node;
        try {
            node = read_node(store_, path);
        } catch (const Error& error) {  // one that is not read is no reason not to read another
            if (error.kind() != ErrorKind::unsupported && error.kind() != ErrorKind::input) throw;
            return;
        }
        if (!node) return;
        if (node->array) {
            if (node->array->rank() >= 2) found_.push_back({path, about_array(*node->array)});
        } else if (is_image(*node)) {
            found_.push_back({path, "image"});
        } else if (depth < kDeepest) {
            group(*node, depth + 1);
        }
    }

    KeyStore& store_;
    std::size_t most_;
    int asked_ = 0;
    std::vector<ZarrChoice> found_;
};

}  // namespace

std::optional<ZarrNode> read_node(KeyStore& store, const std::string& path) {
    if (!path.empty()) require_sound_key(store, path);
    std::optional<ZarrNode> node = node_of_version_3(store, path);
    return node ? node : node_of_version_2(store, path);
}

const Json& ome_of(const Json& attributes) {
    const Json* ome = find_member(attributes, "ome");
    return ome != nullptr && ome->is_object() ? *ome : attributes;
}

std::vector<ZarrChoice> choices_in(KeyStore& store, const ZarrNode& group, std::size_t most) {
    Search search(store, most);
    search.group(group, 0);
    return search.take();
}

std::vector<std::string> labels_of(KeyStore& store, const std::string& image, std::size_t most) {
    try {
        const std::optional<ZarrNode> group = read_node(store, join_key(image, "labels"));
        if (!group || group->array) return {};
        std::vector<std::string> names = paths_in(find_member(ome_of(group->attributes), "labels"), "path");
        if (names.size() > most) names.resize(most);
        return names;
    } catch (const Error& error) {  // the image is read without them
        if (error.kind() != ErrorKind::unsupported && error.kind() != ErrorKind::input) throw;
        return {};
    }
}

std::string parent_of(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

}  // namespace isoatlas
