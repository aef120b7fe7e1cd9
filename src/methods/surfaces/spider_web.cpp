#include "methods/surfaces/spider_web.h"

#include "mesh/extract_level.h"
#include "mesh/layout.h"

namespace isoatlas {

Extraction SpiderWeb::extract(double tau, const Context& context) const {
    ExtractOptions options{.interpolant = interpolant_};
    options.surface.boundary = Boundary::open;
    options.surface.normals = options.surface.ids = false;
    Extraction result;
    const HighBits high = classify(volume_, tau, context);
    extract_level({volume_, tau, high}, options, context, result.surface, &result.cost.active);
    const Index3& size = volume_.info.extent.size;
    const std::int64_t rows = size[1] * size[2];
    result.cost.cells = (size - 1).product();
    result.cost.bytes =
        rows * ((high.words() + 1) * std::int64_t{8} + std::int64_t{sizeof(RowOffsets)});  // a bit a sample, a layout of rows
    return result;
}

}  // namespace isoatlas
