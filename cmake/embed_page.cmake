# Writes OUTPUT, a source file with a function of HEADER (page/template.h), NAME, that gives the bytes of PAGE; no page: no bytes.
if(NOT HEADER)
  set(HEADER page/template.h)
endif()
set(bytes "")
if(PAGE)
  file(READ ${PAGE} hexadecimal HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hexadecimal}")
  string(REGEX REPLACE "(................................................................................................................)" "\\1\n    " bytes "${bytes}")
endif()
file(WRITE ${OUTPUT} "// Made from ${PAGE}.
#include \"${HEADER}\"

namespace isoatlas {
namespace {

const char kPage[] = {
    ${bytes}'\\0'};

}  // namespace

std::string_view ${NAME}() { return {kPage, sizeof kPage - 1}; }

}  // namespace isoatlas
")
