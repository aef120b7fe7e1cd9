// The module isoatlas._core: what each file adds to it. Public headers of isoatlas only, no mathematics: niceties are in Python.
#pragma once

#include <pybind11/pybind11.h>

namespace isoatlas::python {

void add_calls(pybind11::module_& module);
void add_volumes(pybind11::module_& module);
void add_surfaces(pybind11::module_& module);
void add_sources(pybind11::module_& module);
void add_tables(pybind11::module_& module);
void add_trees(pybind11::module_& module);
void add_stores(pybind11::module_& module);
void add_simplified(pybind11::module_& module);
void add_names(pybind11::module_& module);

}  // namespace isoatlas::python
