#include "formats/on_demand/load_part.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

#include "isoatlas/error.h"
#include "isoatlas/text.h"
#include "isoatlas/version.h"

namespace isoatlas {
namespace {

/// Beside the program, wherever it was unpacked.
std::filesystem::path path_of(const std::string& part) {
    std::error_code failure;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failure);
    return (program.parent_path() / ISOATLAS_PARTS_FOLDER / (part + "-" ISOATLAS_VERSION ".so")).lexically_normal();
}

}  // namespace

const void* load_part(const std::string& part, const std::string& library, const std::string& file) {
    void* loaded = ::dlopen(path_of(part).c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = loaded == nullptr ? nullptr : ::dlsym(loaded, "isoatlas_part");
    if (symbol == nullptr) {
        const char* reason = ::dlerror();
        throw Error(ErrorKind::unsupported, {.file = file,
                                             .what = "the part of isoatlas that uses " + library +
                                                     " cannot be loaded: " + shown_name(reason == nullptr ? "" : reason),
                                             .expected = path_of(part).string() + " and the libraries that it needs",
                                             .next = "install the library that is missing, or isoatlas again",
                                             .reason = Reason::built_without_format,
                                             .value = library});
    }
    return reinterpret_cast<const void* (*)()>(symbol)();
}

}  // namespace isoatlas
