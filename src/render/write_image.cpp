// Pictures as files; the format follows the name.
#include "base/atomic_file.h"
#include "isoatlas/render.h"

namespace isoatlas {

void write_image(const std::string& path, const Image& image) {
    if (!path.ends_with(".png")) {
        throw Error(
            ErrorKind::usage,
            {.file = path, .what = "no picture format has this extension", .expected = ".png", .next = "choose a name that ends in .png"});
    }
    const std::vector<std::byte> bytes = encode_png(image);
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace isoatlas
