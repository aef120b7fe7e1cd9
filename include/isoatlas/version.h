// Version of isoatlas; CMakeLists.txt reads it here.
#pragma once

#define ISOATLAS_VERSION "0.2.0"
