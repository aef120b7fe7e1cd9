// Pictures and animations as files; the format follows the name.
#include "base/atomic_file.h"
#include "isoatlas/error.h"
#include "isoatlas/image.h"

namespace isoatlas {
namespace {

void write(const std::string& path, const std::vector<std::byte>& bytes) {
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

[[noreturn]] void unknown(const std::string& path, const std::string& known) {
    throw Error(ErrorKind::usage,
                {.file = path, .what = "unknown extension of a picture", .expected = known, .next = "choose another name"});
}

}  // namespace

void write_image(const std::string& path, const Image& image) {
    if (path.ends_with(".png")) return write(path, encode_png(image));
    if (path.ends_with(".webp")) return write(path, encode_webp({.frames = {image}}, 90));
    unknown(path, ".png, .webp");
}

void write_animation(const std::string& path, const Animation& animation) {
    if (path.ends_with(".gif")) return write(path, encode_gif(animation));
    if (path.ends_with(".png") || path.ends_with(".apng")) return write(path, encode_apng(animation));
    if (path.ends_with(".webp")) return write(path, encode_webp(animation));
    unknown(path, ".gif, .png, .apng, .webp");
}

}  // namespace isoatlas
