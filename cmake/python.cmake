# ISOATLAS_PYTHON: the package for /usr/bin/python3 (or Python3_EXECUTABLE), on where its headers, pybind11 and numpy are there.
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the package is for")
find_package(Python3 QUIET COMPONENTS Interpreter Development.Module NumPy)
set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})  # as pybind11 2.10 calls it
find_package(pybind11 2.10 QUIET CONFIG)
set(has_python OFF)
if(has_all AND Python3_FOUND AND pybind11_FOUND AND NOT ISOATLAS_SANITIZE)  # the interpreter is built without sanitizers
  set(has_python ON)
endif()
cmake_dependent_option(ISOATLAS_PYTHON "Build the Python package" ON has_python OFF)
if(ISOATLAS_PYTHON)
  set(ISOATLAS_PYTHON_FOLDER "" CACHE STRING "Where the package is installed, below the prefix; empty: where its Python looks")
  add_subdirectory(python)
endif()
