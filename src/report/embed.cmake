# Joins page/index.html, page/style.css and the scripts of page/ into one header of raw strings: the page before and
# after its data. Runs at configure time, and again whenever one of the files changes.
set(REPORT_SCRIPTS base overview map chart body camera capsules marks skin player picture layers timeline clip
    certificates main)  # in order

function(embed_report_page folder output)
  set(files index.html style.css verifier.txt)
  set(REPORT_JS "'use strict';\n")
  foreach(script ${REPORT_SCRIPTS})
    list(APPEND files ${script}.js)
    file(READ ${folder}/${script}.js text)
    string(APPEND REPORT_JS "${text}")
  endforeach()
  file(READ ${folder}/style.css REPORT_CSS)
  file(READ ${folder}/verifier.txt VERIFIER)  # tools/verify_wasm; its first line is the compiler
  string(FIND "${VERIFIER}" "\n" line_end)
  string(SUBSTRING "${VERIFIER}" ${line_end} -1 VERIFIER)
  set(REPORT_DATA "@REPORT_DATA@")
  configure_file(${folder}/index.html ${output}.html @ONLY)
  file(READ ${output}.html page)
  string(FIND "${page}" "@REPORT_DATA@" at)
  string(SUBSTRING "${page}" 0 ${at} PAGE_BEFORE)
  string(LENGTH "@REPORT_DATA@" length)
  math(EXPR after "${at} + ${length}")
  string(SUBSTRING "${page}" ${after} -1 PAGE_AFTER)
  configure_file(${folder}/../report_page.h.in ${output} @ONLY)
  list(TRANSFORM files PREPEND ${folder}/)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
endfunction()
