// Phantoms: generated volumes with known answers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct PhantomOptions {
    std::int64_t size = 0;      ///< samples per axis; 0: the phantom's own default
    std::uint64_t seed = 1;     ///< for random ones
    std::int64_t genus = 3;     ///< torus-chain
    std::int64_t shells = 3;    ///< nested-shells
    double noise = 0;           ///< uniform noise of +- this fraction of the range, added last
    std::int64_t quantise = 0;  ///< number of grey levels (2..65536); 0: off. Up to 256 gives uint8, else uint16
};

struct PhantomDescription {
    std::string name, summary;
    std::int64_t default_size;
};
[[nodiscard]] const std::vector<PhantomDescription>& phantoms();

/// The same bytes for the same options on every machine. Throws Error{usage} for an unknown name (with suggestions) or option.
[[nodiscard]] Volume make_phantom(const std::string& name, const PhantomOptions& options = {});

}  // namespace isoatlas
