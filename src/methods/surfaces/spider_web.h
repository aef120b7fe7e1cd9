// The product behind the interface of the comparators (docs/theory/5-surfaces.md, 6-interior.md).
#pragma once

#include "isoatlas/surface_methods.h"

namespace isoatlas {

class SpiderWeb final : public Extractor {
public:
    SpiderWeb(const Volume& volume, Interpolant interpolant) : volume_(volume), interpolant_(interpolant) {}
    Extraction extract(double tau, const Context& context) const override;

private:
    const Volume& volume_;
    Interpolant interpolant_;
};

}  // namespace isoatlas
