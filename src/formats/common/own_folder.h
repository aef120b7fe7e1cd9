// Confines file names of headers to the folder of the header: an untrusted volume must not read other files into a store or a page.
#pragma once

#include <string>

namespace isoatlas {

/// Throws Error{input} when `file`, with all links followed, does not lie in the folder of `header` or below it. Its own folder is the one
/// that the path of the header names, and the one where the header lies when that path is a link. Opens nothing, and the message does not
/// reveal whether the file exists.
void require_own_folder(const std::string& header, const std::string& file);
/// The same for a file that was found in a folder, of slices unless `what` says something else.
void require_inside(const std::string& folder, const std::string& file, const std::string& what = "a slice is a link to a file");

}  // namespace isoatlas
