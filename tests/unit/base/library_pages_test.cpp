#include "base/library_pages.h"

#include <gtest/gtest.h>
#include <link.h>

#include <fstream>

#include "base/pages.h"

namespace isoatlas {
namespace {

std::int64_t resident_pages_of_files() {
    std::int64_t size = 0, resident = 0, of_files = 0;
    std::ifstream("/proc/self/statm") >> size >> resident >> of_files;
    return of_files;
}

/// Reads a byte of each page of the code of libraries, and counts the pages.
int read_code(dl_phdr_info* library, std::size_t, void* count) {
    if (library->dlpi_name == nullptr || *library->dlpi_name != '/') return 0;
    for (int i = 0; i < library->dlpi_phnum; ++i) {
        const ElfW(Phdr)& segment = library->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD || (segment.p_flags & PF_X) == 0) continue;
        const volatile char* byte = reinterpret_cast<const char*>(library->dlpi_addr + segment.p_vaddr);
        for (std::size_t at = 0; at < segment.p_memsz; at += kPage) {
            (void)byte[at];
            ++*static_cast<std::int64_t*>(count);
        }
    }
    return 0;
}

TEST(LibraryPages, OfCodeThatIsNotUsedAreReleased) {
    std::int64_t read = 0;
    (void)::dl_iterate_phdr(read_code, &read);
    ASSERT_GT(read, 100);
    const std::int64_t before = resident_pages_of_files();
    release_library_pages();
    EXPECT_LT(resident_pages_of_files(), before - read / 2);
}

}  // namespace
}  // namespace isoatlas
