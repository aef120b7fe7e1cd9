#include "formats/volume/zarr_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "formats/common/volume_file.h"
#include "formats/zarr/codecs.h"
#include "isoatlas/units.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kCoarsest = 128;

/// "micrometer" for "µm": names of UDUNITS, which OME-Zarr asks for; "": none is known.
std::string udunits_name(const std::string& given) {
    constexpr std::pair<std::string_view, const char*> kUnits[] = {
        {"\xc2\xb5m", "micrometer"}, {"mm", "millimeter"}, {"cm", "centimeter"},     {"m", "meter"}, {"nm", "nanometer"},
        {"pm", "picometer"},         {"km", "kilometer"},  {"\xc3\x85", "angstrom"}, {"in", "inch"}};
    const std::string unit = unit_name(given);
    for (const auto& [name, word] : kUnits) {
        if (unit == name) return word;
    }
    return "";
}

/// Along x, y and z: about a megabyte, sizes that programs like.
Index3 chunk_of_level(const Extent& extent, ValueType type) {
    constexpr std::int64_t kFlat = 512;
    if (extent.rank == 2) return {std::min(kFlat, extent.size[0]), std::min(kFlat, extent.size[1]), 1};
    return min(size_of(type) == 1 ? Index3{128, 128, 128} : Index3{64, 64, 64}, extent.size);
}

template <class T>
std::vector<std::byte> coarser_samples(const Extent& fine, const Extent& coarse, std::span<const std::byte> bytes, Coarsening coarsening) {
    const auto* samples = reinterpret_cast<const T*>(bytes.data());
    std::vector<std::byte> out(static_cast<std::size_t>(coarse.voxels()) * sizeof(T));
    auto* to = reinterpret_cast<T*>(out.data());
    for (std::int64_t i = 0; i < coarse.voxels(); ++i) {
        const Index3 at = coarse.voxel(i);
        Index3 begin{0, 0, 0}, end{1, 1, 1};
        for (std::size_t a = 0; a < 3; ++a) begin[a] = 2 * at[a], end[a] = std::min(begin[a] + 2, fine.size[a]);
        if (coarsening == Coarsening::first) {
            to[i] = samples[fine.index(begin)];
            continue;
        }
        double sum = 0;
        for (std::int64_t z = begin[2]; z < end[2]; ++z) {
            for (std::int64_t y = begin[1]; y < end[1]; ++y) {
                for (std::int64_t x = begin[0]; x < end[0]; ++x) sum += static_cast<double>(samples[fine.index(x, y, z)]);
            }
        }
        const double mean = sum / static_cast<double>((end - begin).product());
        to[i] = static_cast<T>(std::is_integral_v<T> ? std::nearbyint(mean) : mean);
    }
    return out;
}

std::string numpy_type(ValueType type) {
    const char kind = is_floating(type) ? 'f' : name_of(type)[0] == 'u' ? 'u' : 'i';
    const char order = size_of(type) == 1 ? '|' : std::endian::native == std::endian::big ? '>' : '<';
    return std::string{order, kind} + std::to_string(size_of(type));
}

/// Sizes with the slowest axis first.
Json sizes_json(const Index3& size, int rank) {
    Json list = Json::array();
    for (int a = rank; a-- > 0;) list.push_back(size[static_cast<std::size_t>(a)]);
    return list;
}

void write_array(FolderOutput& folder, const std::string& path, const Extent& extent, ValueType type, std::span<const std::byte> samples) {
    const Index3 chunk = chunk_of_level(extent, type);
    const std::size_t sample = size_of(type);
    const Json metadata{{"zarr_format", 2},
                        {"shape", sizes_json(extent.size, extent.rank)},
                        {"chunks", sizes_json(chunk, extent.rank)},
                        {"dtype", numpy_type(type)},
                        {"order", "C"},
                        {"fill_value", 0},
                        {"filters", nullptr},
                        {"dimension_separator", "/"},
                        {"compressor", {{"id", "blosc"}, {"cname", "zstd"}, {"clevel", 5}, {"shuffle", 1}, {"blocksize", 0}}}};
    folder.put(path + "/.zarray", metadata.dump(1));
    std::vector<std::byte> bytes(static_cast<std::size_t>(chunk.product()) * sample);
    for (std::int64_t z = 0; z < extent.size[2]; z += chunk[2]) {
        for (std::int64_t y = 0; y < extent.size[1]; y += chunk[1]) {
            for (std::int64_t x = 0; x < extent.size[0]; x += chunk[0]) {
                std::ranges::fill(bytes, std::byte{0});
                const Index3 begin{x, y, z}, size = min(chunk, extent.size - begin);
                for (std::int64_t row = 0; row < size[1] * size[2]; ++row) {
                    const std::int64_t dy = row % size[1], dz = row / size[1];
                    std::memcpy(bytes.data() + static_cast<std::size_t>(chunk[0] * (dy + chunk[1] * dz)) * sample,
                                samples.data() + static_cast<std::size_t>(extent.index(x, y + dy, z + dz)) * sample,
                                static_cast<std::size_t>(size[0]) * sample);
                }
                if (std::ranges::all_of(bytes, [](std::byte byte) { return byte == std::byte{0}; })) continue;
                std::string key = path;
                if (extent.rank == 3) key += "/" + std::to_string(z / chunk[2]);
                folder.put(key + "/" + std::to_string(y / chunk[1]) + "/" + std::to_string(x / chunk[0]), encode_blosc(bytes, sample));
            }
        }
    }
}

Json transformations(const Geometry& geometry, const Index3& factor, int rank, Coarsening coarsening) {
    Json scale = Json::array(), translation = Json::array();
    for (int i = rank; i-- > 0;) {
        const auto a = static_cast<std::size_t>(i);
        const double step = static_cast<double>(factor[a]), shift = coarsening == Coarsening::mean ? (step - 1) / 2 : 0;
        scale.push_back(geometry.spacing[a] * step);
        translation.push_back(geometry.origin[a] + geometry.spacing[a] * shift);
    }
    return Json::array({{{"type", "scale"}, {"scale", scale}}, {{"type", "translation"}, {"translation", translation}}});
}

Json axes_json(const Geometry& geometry, int rank) {
    Json axes = Json::array();
    const std::string unit = udunits_name(geometry.unit);
    for (int a = rank; a-- > 0;) {
        Json axis{{"name", std::string(1, "xyz"[a])}, {"type", "space"}};
        if (!unit.empty()) axis["unit"] = unit;
        axes.push_back(axis);
    }
    return axes;
}

}  // namespace

Json write_zarr_levels(FolderOutput& folder, const std::string& path, const std::string& name, const VolumeInfo& info,
                       std::span<const std::byte> samples, Coarsening coarsening) {
    const Geometry geometry = regular_geometry(info);
    Extent extent = info.extent;
    Index3 factor{1, 1, 1};
    std::vector<std::byte> own;  // samples of a coarser level
    Json datasets = Json::array();
    for (int level = 0;; ++level) {
        const std::string number = std::to_string(level);
        write_array(folder, path.empty() ? number : path + "/" + number, extent, info.type, samples);
        datasets.push_back({{"path", number}, {"coordinateTransformations", transformations(geometry, factor, extent.rank, coarsening)}});
        if (std::ranges::all_of(extent.size, [](std::int64_t size) { return size <= kCoarsest; })) break;
        Extent coarse = extent;
        for (std::size_t a = 0; a < 3; ++a) {
            if (extent.size[a] == 1) continue;
            coarse.size[a] = (extent.size[a] + 1) / 2;
            factor[a] *= 2;
        }
        own = visit_type(info.type, [&]<class T>(T) { return coarser_samples<T>(extent, coarse, samples, coarsening); });
        samples = own, extent = coarse;
    }
    Json image{{"version", "0.4"}, {"name", name}, {"axes", axes_json(geometry, extent.rank)}, {"datasets", datasets}};
    image["type"] = coarsening == Coarsening::mean ? "mean" : "nearest";
    return Json::array({image});
}

Json zarr_remainder(const VolumeInfo& info) {
    const Geometry& geometry = info.geometry;
    Json direction = Json::array();
    for (const Vec3& row : geometry.direction) direction.push_back(row);
    Json rest{{"space", geometry.space}, {"unit", geometry.unit}, {"direction", direction}};
    if (!info.value_unit.empty()) rest["value_unit"] = info.value_unit;
    if (!info.calibration.is_linear_identity())
        rest["calibration"] = {{"slope", info.calibration.slope}, {"intercept", info.calibration.intercept}};
    return rest;
}

}  // namespace isoatlas
