# Writes OUT, the source of record::commit(), where it changes: a script, run at every build.
#   cmake -DSOURCE=project's folder -DOUT=commit.cpp -P commit.cmake
set(commit unknown)
execute_process(COMMAND git -C ${SOURCE} rev-parse --show-toplevel OUTPUT_VARIABLE top
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
get_filename_component(source ${SOURCE} REALPATH)
if("${top}" STREQUAL "${source}")  # not that of a repository that our sources were copied into
  execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
#include "record/commit.h"

namespace mimicx::record {

const char* commit() { return "@commit@"; }

}  // namespace mimicx::record
]])
