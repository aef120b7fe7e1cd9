// Groups and arrays of a Zarr hierarchy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/zarr/key_store.h"
#include "formats/zarr/zarr_array.h"

namespace isoatlas {

struct ZarrNode {
    std::string path;  ///< "" for the root
    int version = 2;
    std::optional<ZarrArray> array{};  ///< none: a group
    Json attributes = Json::object();  ///< of a group
};

/// The names of keys by which a folder is known to be part of a Zarr hierarchy.
inline constexpr const char* kZarrMarks[] = {"zarr.json", ".zarray", ".zgroup", ".zattrs"};

/// The node at a path; nullopt: there is none. Throws Error: input, unsupported (an array that is not read).
[[nodiscard]] std::optional<ZarrNode> read_node(KeyStore& store, const std::string& path);
/// Its attributes of OME-NGFF: the member "ome" of version 0.5, else all.
[[nodiscard]] const Json& ome_of(const Json& attributes);

/// A thing that can be opened as a volume.
struct ZarrChoice {
    std::string path;
    std::string about;  ///< "512 x 512 x 100 uint16", "image"
};
/// The images and arrays (of 2 axes or more) in a group, at most `most`: fields of a plate or well, images of a collection, labels, images
/// and arrays of nested groups. The labels of an image are not looked for inside of it.
[[nodiscard]] std::vector<ZarrChoice> choices_in(KeyStore& store, const ZarrNode& group, std::size_t most);
/// Names of the labels of an image, at most `most`.
[[nodiscard]] std::vector<std::string> labels_of(KeyStore& store, const std::string& image, std::size_t most);

/// The path of the group that holds a node; "" for those at the root.
[[nodiscard]] std::string parent_of(const std::string& path);

}  // namespace isoatlas
