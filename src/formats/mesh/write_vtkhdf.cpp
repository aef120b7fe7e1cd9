// VTKHDF of one surface, or of several in one list of points: the arrays of VTP in HDF5.
#include "formats/mesh/mesh_formats.h"
#include "formats/mesh/vtkhdf.h"

namespace isoatlas {

void write_vtkhdf(Sink& sink, const MeshParts& parts, Warnings&) {
    Hdf5Layout layout(sink.name(), 0);
    for (const VtkhdfArray& array : vtkhdf_arrays(parts, position_precision(parts))) {
        std::vector<std::int64_t> shape{array.rows};
        if (array.columns > 1) shape.push_back(array.columns);
        place_array(sink, layout, array.name, array.type, shape, array.put);
    }
    place_fields(sink, layout, vtkhdf_fields(parts));
    set_attributes(layout, parts);
    finish_vtkhdf(sink, layout);
}

}  // namespace isoatlas
