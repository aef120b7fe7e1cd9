// Values of critical elements recomputed from their codes and the samples around them.
#pragma once

#include <span>

#include "field/order.h"
#include "field/volume_view.h"

namespace isoatlas {

/// How the values of face and body points are computed.
enum class SaddleValues : unsigned char {
    exact,   ///< rounded once (field/rounding.h)
    earlier  ///< as until version 2 of the store (critical/earlier_values.h)
};

/// The same bits as the scan (critical/scan.h) gave them; NaN where the volume has no such element. tunnel_height: of the scan
/// (tunnel_height_of()). Sizes of codes and values are equal. Cost: O(codes), at random places of the samples.
void find_element_values(std::span<const std::uint64_t> codes, const VolumeView& volume, double tunnel_height, int threads,
                         std::span<double> values, SaddleValues saddles = SaddleValues::exact);

}  // namespace isoatlas
