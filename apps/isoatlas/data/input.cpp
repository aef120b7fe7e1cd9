#include "data/input.h"

#include <utility>

#include "data/session.h"

namespace isoatlas::cli {

Input open_input(const Arguments& arguments) {
    std::unique_ptr<VolumeReader> reader = open_volume(arguments.file, arguments.open);
    if (!arguments.box) return {std::move(reader), std::nullopt};
    VolumeInfo info = reader->info();
    if (!arguments.gaussian || !is_inside(*arguments.box, info.extent))
        return {box_reader(std::move(reader), *arguments.box), std::nullopt};
    if (arguments.voxel_units) info.geometry = voxel_geometry();  // in which the filter will be applied
    const Index3 around = gaussian_radius(info, *arguments.gaussian);
    const SampleBox& box = *arguments.box;
    const SampleBox wide{max(box.begin - around, Index3{}), min(box.end + around, info.extent.size)};
    return {box_reader(std::move(reader), wide), SampleBox{box.begin - wide.begin, box.end - wide.begin}};
}

}  // namespace isoatlas::cli
