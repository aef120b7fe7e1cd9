// VTK before 9.3.1 with an expat that defers its work reads only files in which white space follows the tag of the raw blocks, in a whole
// block of 4096 bytes of the file (VTK issue 19258). Debian's ParaView 5.11 is such a reader.
#include <gtest/gtest.h>

#include <string>

#include "isoatlas/output.h"
#include "isoatlas/phantom.h"
#include "unit/formats/mesh/mesh_samples.h"

namespace isoatlas {
namespace {

constexpr std::size_t kBlock = 4096;  ///< that VTK reads at once

void expect_white_block_after_the_tag(const std::string& file) {
    const std::string tag = "<AppendedData encoding=\"raw\">";
    const std::size_t begin = file.find(tag);
    ASSERT_NE(begin, std::string::npos);
    const std::size_t block = (begin + tag.size() + kBlock - 1) / kBlock * kBlock;
    ASSERT_GT(file.size(), block + kBlock);
    EXPECT_EQ(file.find_first_not_of(" \n", begin + tag.size()), block + kBlock);
    EXPECT_EQ(file[block + kBlock], '_');
}

TEST(VtkWriter, AWhiteBlockFollowsTheTagOfRawBlocks) {
    const mesh_samples::Folder folder;
    // Units of growing length move the tag over the border of a block.
    for (const std::size_t length : {0U, 1U, 700U, 1500U, 3000U}) {
        Volume volume = make_phantom("noise", {.size = 6});
        volume.info.geometry.unit = std::string(length, 'm');
        write_surface(folder / "surface.vtp", extract(volume, 0.5, {}));
        write_tree(folder / "tree.vtu", volume, analyse(volume), {});
        write_volume(folder / "volume.vti", volume);
        for (const char* name : {"surface.vtp", "tree.vtu", "volume.vti"}) {
            SCOPED_TRACE(std::string(name) + ", a unit of " + std::to_string(length));
            expect_white_block_after_the_tag(mesh_samples::read_bytes(folder / name));
        }
    }
}

}  // namespace
}  // namespace isoatlas
