// CellByCell: methods that look at every cell of the volume, as Marching Cubes does, and add triangles of each.
#pragma once

#include "base/cancel.h"
#include "field/volume_view.h"
#include "isoatlas/surface_methods.h"
#include "methods/surfaces/edge_points.h"

namespace isoatlas {

/// AddCell: add(cell, EdgePoints<T>&) of an active cell.
template <class AddCell>
class CellByCell final : public Extractor {
public:
    CellByCell(const Volume& volume, AddCell add) : volume_(volume), add_(add) {}
    Extraction extract(double tau, const Context& context) const override {
        Extraction result;
        visit_samples(volume_, [&](auto samples) { add_cells(samples, tau, context, result); });
        return result;
    }

private:
    template <class T>
    void add_cells(std::span<const T> samples, double tau, const Context& context, Extraction& result) const {
        EdgePoints<T> points(volume_.info, samples, tau, result.surface);
        const Index3 cells = volume_.info.extent.size - 1;
        for (std::int64_t z = 0; z < cells[2]; ++z) {
            stop_if_cancelled(context);
            for (std::int64_t y = 0; y < cells[1]; ++y) {
                for (std::int64_t x = 0; x < cells[0]; ++x) {
                    const Index3 cell{x, y, z};
                    if (const int pattern = points.pattern(cell); pattern == 0 || pattern == 255) continue;
                    ++result.cost.active;
                    add_(cell, points);
                }
            }
        }
        result.cost.cells = cells.product();
        result.cost.bytes = points.bytes();
    }

    const Volume& volume_;
    AddCell add_;
};

}  // namespace isoatlas
