# The page (web/) as one file inside the library. npm bundles it when its sources change; without npm, isoatlas is built without pages.
option(ISOATLAS_WEB "Bundle the web page (needs npm)" ON)
set(ISOATLAS_PAGE_SOURCE ${CMAKE_BINARY_DIR}/page_template.cpp)
set(page_html "")
if(ISOATLAS_WEB)
  find_program(NPM npm)
  if(NOT NPM)
    message(FATAL_ERROR "npm is missing: apt-get install nodejs npm, or configure with -DISOATLAS_WEB=OFF (then there are no pages)")
  endif()
  set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
  set(web_build ${CMAKE_BINARY_DIR}/web)  # the source tree stays clean
  file(GLOB web_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/tests/* ${web}/*.html ${web}/*.ts ${web}/*.json)
  set(page_html ${web_build}/dist/atlas.html)
  add_custom_command(OUTPUT ${web_build}/installed
    COMMAND ${CMAKE_COMMAND} -E make_directory ${web_build}
    COMMAND ${CMAKE_COMMAND} -E copy ${web}/package.json ${web}/package-lock.json ${web_build}
    COMMAND ${NPM} --prefix ${web_build} ci --no-audit --no-fund --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch ${web_build}/installed
    DEPENDS ${web}/package.json ${web}/package-lock.json COMMENT "Installing the packages of web/" VERBATIM)
  add_custom_command(OUTPUT ${page_html}
    COMMAND ${CMAKE_COMMAND} -E copy ${web}/atlas.html ${web}/tsconfig.json ${web}/vite.config.ts ${web_build}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${web_build}/src ${web_build}/tests
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/src ${web_build}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/tests ${web_build}/tests
    COMMAND ${NPM} --prefix ${web_build} run --silent build
    DEPENDS ${web_build}/installed ${web_sources} COMMENT "Bundling the page" VERBATIM)
endif()
add_custom_command(OUTPUT ${ISOATLAS_PAGE_SOURCE}
  COMMAND ${CMAKE_COMMAND} -DPAGE=${page_html} -DOUTPUT=${ISOATLAS_PAGE_SOURCE} -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_page.cmake
  DEPENDS ${page_html} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_page.cmake VERBATIM)
