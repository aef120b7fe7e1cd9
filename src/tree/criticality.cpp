#include "isoatlas/criticality.h"

namespace isoatlas {

const char* name_of(Criticality kind) {
    static constexpr const char* kName[] = {"maximum", "minimum", "merge", "split", "genus change", "complex"};
    return kName[static_cast<int>(kind)];
}

Criticality mirrored(Criticality kind) {
    if (kind == Criticality::maximum) return Criticality::minimum;
    return kind == Criticality::minimum ? Criticality::maximum : kind;
}

}  // namespace isoatlas
