// Exceptions of Python from those of C++.
#pragma once

namespace isoatlas::python {

/// Every isoatlas::Error of this module becomes the class of isoatlas.errors that belongs to its kind, with the parts of its text as
/// attributes; memory that is refused becomes ResourceError.
void translate_exceptions();

}  // namespace isoatlas::python
