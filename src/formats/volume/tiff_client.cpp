#include "formats/volume/tiff_client.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <span>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kLongestMessage = 400;

TiffClient& client_of(thandle_t handle) { return *static_cast<TiffClient*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* data, tmsize_t count) {
    TiffClient& client = client_of(handle);
    std::span<std::byte> out(static_cast<std::byte*>(data), static_cast<std::size_t>(std::max<tmsize_t>(count, 0)));
    try {
        const std::size_t done = read_available(*client.file, client.path, client.position, out);
        client.position += static_cast<std::int64_t>(done);
        return static_cast<tmsize_t>(done);
    } catch (const Error& error) {
        client.say(error.text().what);
        return -1;
    }
}

tmsize_t write_bytes(thandle_t, void*, tmsize_t) { return -1; }

toff_t seek_bytes(thandle_t handle, toff_t offset, int origin) {
    TiffClient& client = client_of(handle);
    const std::int64_t base = origin == SEEK_CUR ? client.position : origin == SEEK_END ? client.file->size() : 0;
    std::int64_t position = 0;
    if (__builtin_add_overflow(base, static_cast<std::int64_t>(offset), &position) || position < 0) return static_cast<toff_t>(-1);
    client.position = position;
    return static_cast<toff_t>(position);
}

int close_bytes(thandle_t) { return 0; }

toff_t size_of_bytes(thandle_t handle) { return static_cast<toff_t>(client_of(handle).file->size()); }

int on_error(TIFF*, void* data, const char*, const char* format, va_list arguments) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, arguments);
    static_cast<TiffClient*>(data)->say(text);
    return 1;  // handled: nothing is printed
}

int on_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }  // unknown tags and similar: harmless

}  // namespace

void TiffClient::say(const std::string& text) {
    if (messages.size() + text.size() < kLongestMessage) messages += (messages.empty() ? "" : "; ") + text;
}

TIFF* open_tiff_client(TiffClient& client) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    if (options == nullptr) throw Error(ErrorKind::resource, {.file = client.path, .what = "not enough memory to open the file"});
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, &client);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, &client);
    // libtiff itself needs compressed strips, tables and codec states: in proportion to the file, not to sizes it claims.
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, (std::int64_t{64} << 20) + 2 * client.file->size());
    TIFF* tiff = TIFFClientOpenExt(client.path.c_str(), "rmc", &client, read_bytes, write_bytes, seek_bytes, close_bytes, size_of_bytes,
                                   nullptr, nullptr, options);
    TIFFOpenOptionsFree(options);
    return tiff;
}

}  // namespace isoatlas
