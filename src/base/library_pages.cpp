#include "base/library_pages.h"

#include <link.h>
#include <sys/mman.h>

#include <cstdint>
#include <span>

#include "base/pages.h"

namespace isoatlas {
namespace {

/// Does the loader write into the code of the library?
bool has_changed_code(const dl_phdr_info& library, std::span<const ElfW(Phdr)> segments) {
    for (const ElfW(Phdr) & segment : segments) {
        if (segment.p_type != PT_DYNAMIC) continue;
        const auto* entry = reinterpret_cast<const ElfW(Dyn)*>(library.dlpi_addr + segment.p_vaddr);  // NOLINT(performance-no-int-to-ptr)
        for (; entry->d_tag != DT_NULL; ++entry) {
            if (entry->d_tag == DT_TEXTREL) return true;
        }
    }
    return false;
}

/// Whole pages: those at the ends may be of another segment.
void release(std::uintptr_t begin, std::uintptr_t end) {
    begin = rounded_up(begin, kPage);
    end -= end % kPage;
    if (begin < end) (void)::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);  // NOLINT(performance-no-int-to-ptr)
}

/// The program itself is left alone: a debugger has its breakpoints there.
int release_library(dl_phdr_info* library, std::size_t, void*) {
    const std::span segments(library->dlpi_phdr, library->dlpi_phnum);
    if (library->dlpi_name == nullptr || *library->dlpi_name == '\0' || has_changed_code(*library, segments)) return 0;
    for (const ElfW(Phdr) & segment : segments) {
        if (segment.p_type != PT_LOAD || (segment.p_flags & PF_W) != 0) continue;
        const std::uintptr_t begin = library->dlpi_addr + segment.p_vaddr;
        release(begin, begin + segment.p_memsz);
    }
    return 0;
}

}  // namespace

// The loader's lock, which is held meanwhile, keeps the libraries where they are.
void release_library_pages() noexcept { (void)::dl_iterate_phdr(release_library, nullptr); }

}  // namespace isoatlas
