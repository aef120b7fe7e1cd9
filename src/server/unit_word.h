// unit=um: the unit of lengths of a volume whose file says none.
#pragma once

#include <string>

#include "isoatlas/volume.h"
#include "server/query_parameters.h"

namespace isoatlas {

/// The unit of the file, or that of the request. Throws Error{usage} when the request names another one than the file, or more than a name.
[[nodiscard]] std::string unit_of_lengths(QueryParameters& words, const Geometry& geometry);

}  // namespace isoatlas
