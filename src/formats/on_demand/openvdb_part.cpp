// The library that formats/on_demand/openvdb_on_demand.cpp loads.
#include "formats/volume/vdb_library.h"

extern "C" const void* isoatlas_part();
extern "C" const void* isoatlas_part() { return &isoatlas::kOpenVdb; }
