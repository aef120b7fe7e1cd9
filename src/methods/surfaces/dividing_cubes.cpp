#include "methods/surfaces/dividing_cubes.h"

#include "base/cancel.h"
#include "field/volume_view.h"
#include "methods/surfaces/cell_divider.h"

namespace isoatlas {

Extraction DividingCubes::extract(double tau, const Context& context) const {
    Extraction result;
    const Index3 cells = volume_.info.extent.size - 1;
    visit_samples(volume_, [&]<class T>(std::span<const T> samples) {
        CellDivider<T> divider(volume_.info, samples, tau, divisions_, result.points);
        for (std::int64_t z = 0; z < cells[2]; ++z) {
            stop_if_cancelled(context);
            for (std::int64_t y = 0; y < cells[1]; ++y) {
                for (std::int64_t x = 0; x < cells[0]; ++x) result.cost.active += static_cast<std::int64_t>(divider.divide({x, y, z}));
            }
        }
    });
    result.cost.cells = cells.product();
    return result;
}

}  // namespace isoatlas
