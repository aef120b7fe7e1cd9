// Alone in its file: a program that loads OpenVDB on demand, or a test without it, has another one.
#include "formats/volume/vdb_library.h"

#include "isoatlas/error.h"

namespace isoatlas {

#ifdef ISOATLAS_WITH_OPENVDB

const VdbLibrary& vdb_library(const std::string&) { return kOpenVdb; }

#else

const VdbLibrary& vdb_library(const std::string& file) {
    throw Error(ErrorKind::unsupported, {.file = file,
                                         .what = "this build has no OpenVDB",
                                         .expected = "a build with OpenVDB",
                                         .next = "install the package libopenvdb-dev and build again, or take .nrrd",
                                         .reason = Reason::built_without_format,
                                         .value = "OpenVDB"});
}

#endif

}  // namespace isoatlas
