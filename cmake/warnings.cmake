# Flags of every target of ours. Contraction stays off: a*c - b*d must round the same on every machine
# (docs/theory/1-elements-and-order.md#numbers).
add_library(isoatlas_flags INTERFACE)
target_compile_features(isoatlas_flags INTERFACE cxx_std_20)
target_compile_options(isoatlas_flags INTERFACE
  -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # g++ 12 warns wrongly about std::string operator+ (gcc bug 105651)
  $<$<AND:$<BOOL:${ISOATLAS_UNITY}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>  # g++ takes what is included for a header
  $<$<CXX_COMPILER_ID:Clang>:-Wno-deprecated-declarations>  # get_temporary_buffer in std::stable_sort of libstdc++ 12
  $<$<CONFIG:Debug>:-D_GLIBCXX_ASSERTIONS>)
# g++ 12 loses the rounding in double -> float -> double when it vectorises straight-line code (tests/unit/output: precision notices).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(isoatlas_flags INTERFACE -fno-tree-slp-vectorize)
  # It warns of std::string operator+ as of memory that does not exist (gcc bugs 105329, 105651); later ones and clang do not.
  target_compile_options(isoatlas_flags INTERFACE -Wno-array-bounds -Wno-stringop-overflow)
endif()
if(ISOATLAS_SANITIZE)
  target_compile_options(isoatlas_flags INTERFACE -fsanitize=${ISOATLAS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(isoatlas_flags INTERFACE -fsanitize=${ISOATLAS_SANITIZE})
  if(ISOATLAS_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(isoatlas_flags INTERFACE -Wno-tsan)  # fences of Boost.Asio, which has locks beside them
  endif()
endif()
