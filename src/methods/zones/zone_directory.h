// Where the lists of a file of zones are.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/volume.h"
#include "methods/disk/interval_tree_format.h"
#include "methods/zones/spool.h"
#include "methods/zones/zone_tree.h"

namespace isoatlas {

/// The list of a component.
struct ZoneList {
    ZoneNodeId node;
    std::uint32_t filed = 0;    ///< its cells, those with equal samples included
    std::uint32_t count = 0;    ///< its entries
    double low = 0, high = 0;   ///< of its entries
    IntervalTreePlace place{};  ///< no levels: a list in one block, by highest sample
};

/// What follows the lists in the file.
struct ZoneDirectory {
    VolumeInfo info;
    StoredTree tree;
    std::vector<ZoneList> lists;  ///< in the order of their nodes
};

// The file: its header, the lists as blocks of entries and nodes of interval trees, and the directory, as a stream of bytes.
inline constexpr std::string_view kZoneMagic = "isoatlas ZONES 1";
/// Numbers of the header.
inline constexpr std::size_t kZoneLayout = 0, kDirectory = 1, kDirectoryBytes = 2;

/// lists: in the order of their nodes.
void put_directory(StreamWriter& stream, const VolumeInfo& info, const EventChains& events, const Spool<ZoneList>& lists);
/// Throws Error{input}: contents contradict each other.
[[nodiscard]] ZoneDirectory get_directory(PayloadReader& payload, const BlockReader& file, ZoneLayout layout);

}  // namespace isoatlas
