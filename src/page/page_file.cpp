#include "page/page_file.h"

#include "base/atomic_file.h"
#include "catalogue/page_mesh.h"
#include "isoatlas/error.h"
#include "page/template.h"

namespace isoatlas {
namespace {

/// JSON inside a script element: escapes everything that could end the element.
std::string escaped(const std::string& json) {
    std::string text;
    text.reserve(json.size());
    for (const char letter : json) text += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
    return text;
}

}  // namespace

void check_page_options(const PageOptions& options) {
    const auto refuse = [](const char* what, const char* expected) { throw Error(ErrorKind::usage, {.what = what, .expected = expected}); };
    if (options.picture_size < 32 || options.picture_size > 1024) refuse("the size of the pictures is out of range", "32 to 1024");
    if (options.frames < 1 || options.frames > 64) refuse("the number of frames is out of range", "1 to 64");
    if (options.frames * options.picture_size > 16383) refuse("a turntable is too wide", "frames times size at most 16383");
    if (options.top < 1 || options.top_cavities < 0) refuse("the number of objects is out of range", "1 or more, of cavities 0 or more");
}

void check_has_pages() {
    if (!page_template().empty()) return;
    throw Error(ErrorKind::unsupported, {.what = "this isoatlas was built without pages",
                                         .next = "install npm and build it again with its pages",
                                         .reason = Reason::built_without_web});
}

std::int64_t bytes_for_meshes(const std::string& json, std::int64_t meshes) {
    constexpr std::int64_t kWords = 100;  // members of a mesh beside its data
    return kMaxPageBytes - std::ssize(page_template()) - std::ssize(json) - kWords * meshes;
}

std::int64_t write_page_file(const std::string& path, const std::string& json) {
    const std::string_view page = page_template(), mark = R"(<script id="atlas-data" type="application/json">null</script>)";
    const std::size_t at = page.find(mark), data = at + mark.find("null");
    AtomicFile file(path);
    file.write(page.substr(0, data));
    file.write(escaped(json));
    file.write(page.substr(data + 4));
    const std::int64_t bytes = file.size();
    file.commit();
    return bytes;
}

}  // namespace isoatlas
