// Names that users give to objects and cavities of a volume. They lie in a file beside the store, STORE.names.json
// (docs/schema/names.schema.json), and stay valid when the table of objects has other lines. Names of objects of low values have a file of
// their own.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/polarity.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// The name of an object or cavity at an isovalue.
struct ObjectName {
    std::string name;
    std::int64_t voxel = 0;  ///< ObjectEntry::id or CavityEntry::id
    double isovalue = 0;     ///< calibrated
    bool is_cavity = false;
    friend bool operator==(const ObjectName&, const ObjectName&) = default;
};

/// The file beside a store: STORE.names.json. Of low values: scan.low.atlas.names.json, beside scan.atlas as beside scan.low.atlas, which
/// number the same objects.
[[nodiscard]] std::string object_names_path(const std::string& store, Polarity polarity = Polarity::high);

/// Empty when there is no such file. extent: of the volume. Throws Error: input (damaged, or of a volume of another extent).
[[nodiscard]] std::vector<ObjectName> read_object_names(const std::string& path, const Extent& extent);

/// Replaces the file; without names it is removed. Throws Error: usage (an invalid or repeated name), resource.
void write_object_names(const std::string& path, const Extent& extent, std::span<const ObjectName> names);

/// A name is UTF-8 of at most 100 bytes without control characters, '@', ',' and '/', does not begin with '-' or a blank nor end with one,
/// and is not taken for a reference: a number, or c or v and a number, also with low before it. Throws Error{usage}.
void check_object_name(const std::string& name);

/// Gives an object a name, instead of the one it has. Throws Error{usage} when the name is invalid or another object has it; the message
/// says which.
void set_object_name(std::vector<ObjectName>& names, const ObjectName& given);

/// nullptr: there is none.
[[nodiscard]] const ObjectName* find_object_name(std::span<const ObjectName> names, const std::string& name);
/// Of the object or cavity with this id at this (calibrated) isovalue.
[[nodiscard]] const ObjectName* find_object_name(std::span<const ObjectName> names, bool is_cavity, std::int64_t voxel, double isovalue);

}  // namespace isoatlas
