// Requests to the server: "path?name=text&...", a '^' before them for a wrong token, a '!' for each time that whoever asks is still there
// when the server looks. Any of them gets an answer of a known status, and a refusal says why.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <unistd.h>

#include "base/check.h"
#include "isoatlas/build.h"
#include "isoatlas/phantom.h"
#include "server/service.h"

namespace {

using namespace isoatlas;

/// A small store for all requests; its file is removed once it is open.
const Atlas& small_atlas() {
    static const Atlas atlas = [] {
        const std::string path = (std::filesystem::temp_directory_path() / ("service_fuzz_" + std::to_string(::getpid()))).string();
        build_atlas(path, make_phantom("noise", {.size = 8, .quantise = 8}));
        Atlas opened(path);
        std::filesystem::remove(path);
        return opened;
    }();
    return atlas;
}

Request request_of(std::string_view text) {
    Request request;
    request.token = "right";
    request.client = "fuzz";
    if (text.starts_with('^')) request.token = "wrong", text.remove_prefix(1);
    if (const std::size_t looks = std::min(text.find_first_not_of('!'), text.size()); looks > 0) {
        request.is_disconnected = [left = looks]() mutable { return left == 0 || --left == 0; };
        text.remove_prefix(looks);
    }
    const std::size_t mark = text.find('?');
    request.path = text.substr(0, mark);
    while (mark != std::string_view::npos) {
        text.remove_prefix(text.find_first_of("?&") + 1);
        const std::string_view word = text.substr(0, text.find('&'));
        const std::size_t equal = word.find('=');
        request.words.emplace(word.substr(0, equal), equal == std::string_view::npos ? std::string_view() : word.substr(equal + 1));
        if (word.size() == text.size()) break;
    }
    return request;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > 8192) return 0;  // what HTTP lets through
    Context context;
    context.threads = 1;
    static Service knowing("right", context);
    const Request request = request_of({reinterpret_cast<const char*>(data), size});
    std::optional<Service> fresh;  // what is given up may be what is found first
    if (request.is_disconnected) fresh.emplace("right", context);
    Service& service = fresh ? *fresh : knowing;
    service.store_state().open(small_atlas());
    const Response answer = service.answer(request);
    const bool given_up = answer.status == 409 && request.is_disconnected;
    ISOATLAS_CHECK(given_up || answer.status == 200 || answer.status == 400 || answer.status == 403 || answer.status == 404);
    ISOATLAS_CHECK(answer.status == 403 || request.token == "right" || request.path == "/");
    ISOATLAS_CHECK(answer.status == 200 || answer.bytes.find("\"message\":\"") != std::string::npos);
    return 0;
}
