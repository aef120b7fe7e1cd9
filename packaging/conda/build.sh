#!/usr/bin/env bash
# Run by conda build, in the sources: PREFIX, PYTHON and CMAKE_ARGS are its own.
set -euo pipefail
# shellcheck disable=SC2086
cmake -G Ninja -S . -B build/conda ${CMAKE_ARGS:-} -DCMAKE_BUILD_TYPE=Release -DISOATLAS_TESTS=OFF -DISOATLAS_UNITY=ON -DISOATLAS_PYTHON=ON \
    -DPython3_EXECUTABLE="$PYTHON"
cmake --build build/conda
for component in cli python_package; do cmake --install build/conda --component "$component" --prefix "$PREFIX"; done
