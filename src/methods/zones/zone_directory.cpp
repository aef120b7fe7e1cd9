#include "methods/zones/zone_directory.h"

#include "methods/zones/block_stream.h"

namespace isoatlas {
namespace {

/// All that a surface needs beside samples.
void put_info(StreamWriter& stream, const VolumeInfo& info) {
    stream.put(static_cast<std::int64_t>(info.type)), stream.put(std::int64_t{info.extent.rank});
    for (int axis = 0; axis < 3; ++axis) stream.put(info.extent.size[axis]);
    const Geometry& geometry = info.geometry;
    stream.put(geometry.spacing), stream.put(geometry.origin), stream.put(geometry.direction);
    for (const auto& axis : geometry.coordinates) put_array(stream, axis);
    put_array(stream, geometry.space), put_array(stream, geometry.unit);
    const Calibration& calibration = info.calibration;
    stream.put(calibration.slope), stream.put(calibration.intercept);
    stream.put(std::int64_t{calibration.mirror.has_value()}), stream.put(calibration.mirror.value_or(0));
}

VolumeInfo get_info(PayloadReader& payload, const BlockReader& file) {
    VolumeInfo info;
    const auto type = payload.get<std::int64_t>(), rank = payload.get<std::int64_t>();
    if (type < 0 || type > static_cast<std::int64_t>(ValueType::f64)) file.fail("the type of the samples is unknown");
    if (rank != 2 && rank != 3) file.fail("the volume has no rank");
    info.type = static_cast<ValueType>(type), info.extent.rank = static_cast<int>(rank);
    for (int axis = 0; axis < 3; ++axis) info.extent.size[axis] = payload.get<std::int64_t>();
    Geometry& geometry = info.geometry;
    geometry.spacing = payload.get<Vec3>(), geometry.origin = payload.get<Vec3>(), geometry.direction = payload.get<Mat3>();
    for (auto& axis : geometry.coordinates) get_array(payload, file, axis);
    get_array(payload, file, geometry.space), get_array(payload, file, geometry.unit);
    Calibration& calibration = info.calibration;
    calibration.slope = payload.get<double>(), calibration.intercept = payload.get<double>();
    const bool is_mirrored = payload.get<std::int64_t>() != 0;
    const auto mirror = payload.get<double>();
    if (is_mirrored) calibration.mirror = mirror;
    return info;
}

void put_list(StreamWriter& stream, const ZoneList& list) {
    stream.put(list.node.number()), stream.put(list.filed), stream.put(list.count), stream.put(list.low), stream.put(list.high);
    stream.put(list.place.levels), stream.put(list.place.root), stream.put(list.place.list.first), stream.put(list.place.list.count);
}

ZoneList get_list(PayloadReader& payload) {
    ZoneList list;
    list.node = ZoneNodeId(payload.get<ZoneNodeId::Number>());
    list.filed = payload.get<std::uint32_t>(), list.count = payload.get<std::uint32_t>();
    list.low = payload.get<double>(), list.high = payload.get<double>();
    list.place.levels = payload.get<std::int64_t>(), list.place.root = payload.get<std::int64_t>();
    list.place.list.first = payload.get<std::int64_t>(), list.place.list.count = payload.get<std::uint32_t>();
    return list;
}

}  // namespace

void put_directory(StreamWriter& stream, const VolumeInfo& info, const EventChains& events, const Spool<ZoneList>& lists) {
    put_info(stream, info);
    put_tree(stream, events);
    stream.put(static_cast<std::int64_t>(lists.size()));
    lists.for_each([&](const ZoneList& list) { put_list(stream, list); });
}

ZoneDirectory get_directory(PayloadReader& payload, const BlockReader& file, ZoneLayout layout) {
    ZoneDirectory directory{get_info(payload, file), get_tree(payload, file), {}};
    const std::size_t nodes = nodes_of_events(directory.tree, layout).count;
    const auto lists = payload.get<std::int64_t>();
    for (std::int64_t i = 0; i < lists; ++i) {
        directory.lists.push_back(get_list(payload));
        if (directory.lists.back().node.index() >= nodes) file.fail("a list belongs to no zone");
        if (i > 0 && directory.lists.back().node < directory.lists[static_cast<std::size_t>(i - 1)].node)
            file.fail("the lists are out of order");
    }
    return directory;
}

}  // namespace isoatlas
