// The types of samples (ValueType, isoatlas/volume.h), for templates that are instantiated for each of them.
#pragma once

#include <cstdint>

/// X(type) of each.
#define ISOATLAS_FOR_SAMPLE_TYPES(X) \
    X(std::uint8_t) X(std::int8_t) X(std::uint16_t) X(std::int16_t) X(std::uint32_t) X(std::int32_t) X(float) X(double)
