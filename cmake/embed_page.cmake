# Writes OUTPUT, a source file with a function of page/template.h, NAME, that gives the bytes of PAGE; no page: no bytes.
set(bytes "")
if(PAGE)
  file(READ ${PAGE} hexadecimal HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hexadecimal}")
  string(REGEX REPLACE "(................................................................................................................)" "\\1\n    " bytes "${bytes}")
endif()
file(WRITE ${OUTPUT} "// Made from web/.
#include \"page/template.h\"

namespace isoatlas {
namespace {

const char kPage[] = {
    ${bytes}'\\0'};

}  // namespace

std::string_view ${NAME}() { return {kPage, sizeof kPage - 1}; }

}  // namespace isoatlas
")
