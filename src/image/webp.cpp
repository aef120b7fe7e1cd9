// WebP, still and moving, by libwebp.
#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <memory>

#include "image/animation.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxWebpSide = 16383;

[[noreturn]] void fail(const std::string& what) {
    throw Error(ErrorKind::resource, {.what = "WebP encoding failed: " + what, .next = "write .png or .gif, or smaller frames"});
}

struct PictureOwner {
    WebPPicture picture{};
    PictureOwner() { WebPPictureInit(&picture); }
    ~PictureOwner() { WebPPictureFree(&picture); }
    PictureOwner(const PictureOwner&) = delete;
    PictureOwner& operator=(const PictureOwner&) = delete;
};

struct Data {
    WebPData data{};
    Data() { WebPDataInit(&data); }
    ~Data() { WebPDataClear(&data); }
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;
};

WebPConfig config_of(double quality) {
    WebPConfig config;
    WebPConfigInit(&config);
    config.quality = static_cast<float>(quality);
    config.lossless = quality >= 100 ? 1 : 0;
    config.method = 4;
    config.thread_level = 0;
    return config;
}

}  // namespace

std::vector<std::byte> encode_webp(const Animation& animation, double quality) {
    check_animation(animation, kMaxWebpSide);
    const Image& first = animation.frames[0];
    WebPAnimEncoderOptions options;
    WebPAnimEncoderOptionsInit(&options);
    const std::unique_ptr<WebPAnimEncoder, void (*)(WebPAnimEncoder*)> encoder(
        WebPAnimEncoderNew(static_cast<int>(first.width), static_cast<int>(first.height), &options), WebPAnimEncoderDelete);
    if (!encoder) fail("not enough memory");
    const WebPConfig config = config_of(quality);
    const auto time = [&](std::size_t frame) {
        return static_cast<int>(std::lround(1000 * static_cast<double>(frame) / animation.frames_per_second));
    };
    for (std::size_t i = 0; i < animation.frames.size(); ++i) {
        PictureOwner owner;
        owner.picture.use_argb = 1;
        owner.picture.width = static_cast<int>(first.width), owner.picture.height = static_cast<int>(first.height);
        if (WebPPictureImportRGBA(&owner.picture, animation.frames[i].rgba.data(), static_cast<int>(4 * first.width)) == 0 ||
            WebPAnimEncoderAdd(encoder.get(), &owner.picture, time(i), &config) == 0)
            fail(WebPAnimEncoderGetError(encoder.get()));
    }
    Data assembled;
    if (WebPAnimEncoderAdd(encoder.get(), nullptr, time(animation.frames.size()), nullptr) == 0 ||
        WebPAnimEncoderAssemble(encoder.get(), &assembled.data) == 0)
        fail(WebPAnimEncoderGetError(encoder.get()));
    const auto* begin = reinterpret_cast<const std::byte*>(assembled.data.bytes);
    return {begin, begin + assembled.data.size};
}

}  // namespace isoatlas
