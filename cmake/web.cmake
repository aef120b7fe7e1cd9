# Bundles the pages (web/) with npm and embeds them into the library; with ISOATLAS_WEB=OFF there are no pages. ISOATLAS_WEB_DIST: a folder
# in which they are bundled already, such as BUILD/web/dist of another build of the same sources; then no npm is needed.
option(ISOATLAS_WEB "Bundle the web pages (needs npm)" ON)
set(ISOATLAS_WEB_DIST "" CACHE PATH "Folder with the bundled pages; empty: npm bundles them")
set(ISOATLAS_PAGES page viewer)  # page/template.h: page_template(), viewer_template()
set(page_file atlas.html)
set(viewer_file viewer.html)
set(web ${CMAKE_CURRENT_SOURCE_DIR}/web)
set(web_build ${CMAKE_BINARY_DIR}/web)  # the source tree stays clean
set(web_outputs "")
if(ISOATLAS_WEB AND ISOATLAS_WEB_DIST)
  set(web_dist ${ISOATLAS_WEB_DIST})
  foreach(name IN LISTS ISOATLAS_PAGES)
    if(NOT EXISTS ${web_dist}/${${name}_file})
      message(FATAL_ERROR "ISOATLAS_WEB_DIST has no ${${name}_file}: name the folder web/dist of a finished build, or leave it out")
    endif()
  endforeach()
elseif(ISOATLAS_WEB)
  set(web_dist ${web_build}/dist)
  find_program(NPM npm)
  if(NOT NPM)
    message(FATAL_ERROR "npm is missing: apt-get install nodejs npm, or configure with -DISOATLAS_WEB=OFF (then there are no pages)")
  endif()
  file(GLOB_RECURSE web_sources CONFIGURE_DEPENDS ${web}/src/* ${web}/tests/* ${web}/*.html ${web}/*.ts ${web}/*.json)
  foreach(name IN LISTS ISOATLAS_PAGES)
    list(APPEND web_outputs ${web_dist}/${${name}_file})
  endforeach()
  add_custom_command(OUTPUT ${web_build}/installed
    COMMAND ${CMAKE_COMMAND} -E make_directory ${web_build}
    COMMAND ${CMAKE_COMMAND} -E copy ${web}/package.json ${web}/package-lock.json ${web_build}
    COMMAND ${NPM} --prefix ${web_build} ci --no-audit --no-fund --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch ${web_build}/installed
    DEPENDS ${web}/package.json ${web}/package-lock.json COMMENT "Installing the packages of web/" VERBATIM)
  add_custom_command(OUTPUT ${web_outputs}
    COMMAND ${CMAKE_COMMAND} -E copy ${web}/atlas.html ${web}/viewer.html ${web}/tsconfig.json ${web}/vite.config.ts ${web_build}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${web_build}/src ${web_build}/tests
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/src ${web_build}/src
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${web}/tests ${web_build}/tests
    COMMAND ${NPM} --prefix ${web_build} run --silent build
    DEPENDS ${web_build}/installed ${web_sources} COMMENT "Bundling the pages" VERBATIM)
endif()
set(ISOATLAS_PAGE_SOURCES "")
foreach(name IN LISTS ISOATLAS_PAGES)
  set(source ${CMAKE_BINARY_DIR}/${name}_template.cpp)
  set(html "")
  if(ISOATLAS_WEB)
    set(html ${web_dist}/${${name}_file})
  endif()
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DPAGE=${html} -DOUTPUT=${source} -DNAME=${name}_template -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_page.cmake
    DEPENDS ${html} ${CMAKE_CURRENT_SOURCE_DIR}/cmake/embed_page.cmake VERBATIM)
  list(APPEND ISOATLAS_PAGE_SOURCES ${source})
endforeach()
