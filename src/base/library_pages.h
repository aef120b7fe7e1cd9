// Pages of shared libraries that only their start has needed.
#pragma once

namespace isoatlas {

/// Unmaps the read-only pages of the shared libraries of this process; those that are used again come back from the system's cache of
/// files. Libraries of formats have 30 MB resident once they are loaded, and use a small part of it.
void release_library_pages() noexcept;

}  // namespace isoatlas
