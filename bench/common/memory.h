// Peak memory of a call beyond its input, measured in a process that has done nothing but load the volume.
//
// It gives freed pages back, resets the kernel's high-water mark of resident memory (/proc/self/clear_refs) and reads the resident size;
// after the call it reads the high-water mark (VmHWM). The difference is what the call needed at its peak, its result, thread stacks and
// allocator overhead included.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// Runs this program again as `arguments` and returns the number of bytes it prints. Throws std::runtime_error when it fails.
[[nodiscard]] std::int64_t peak_bytes_of_child(const std::vector<std::string>& arguments);

/// Resident bytes now, with the high-water mark reset to it. Throws std::runtime_error where the kernel does not offer it.
[[nodiscard]] std::int64_t reset_peak();
/// The high-water mark since then.
[[nodiscard]] std::int64_t peak();

}  // namespace bench
