// Measures of objects, as dicts.
#pragma once

#include <pybind11/pybind11.h>

namespace isoatlas::python {

void add_measures(pybind11::module_& module);

}  // namespace isoatlas::python
