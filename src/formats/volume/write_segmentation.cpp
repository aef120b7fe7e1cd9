#include "base/atomic_file.h"
#include "formats/common/byte_writer.h"
#include "isoatlas/output.h"
#include "isoatlas/segmentation.h"

namespace isoatlas {

std::vector<std::string> write_segmentation(const std::string& path, std::span<const std::uint32_t> labels,
                                            std::span<const Segment> segments, const VolumeInfo& info) {
    write_labels(path, info, labels);
    std::string table = "label,name,red,green,blue,isovalue,voxels\n";
    for (const Segment& segment : segments) {
        table += std::to_string(segment.number) + ",\"" + segment.name + "\"";
        for (const std::uint8_t part : segment.colour) table += "," + std::to_string(part);
        table += "," + number_text(segment.isovalue) + "," + std::to_string(segment.voxels) + "\n";
    }
    AtomicFile file(path + ".csv");
    file.write(table);
    file.commit();
    return {};
}

std::vector<std::string> write_segmentation(Sink& sink, std::span<const std::uint32_t> labels, std::span<const Segment> /*segments*/,
                                            const VolumeInfo& info) {
    write_labels(sink, info, labels, {.interpolant = Interpolant::trilinear, .tau = {}});
    return {};
}

}  // namespace isoatlas
