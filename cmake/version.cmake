# Writes what made this binary into a header; leaves the file alone where nothing changed, so nothing is rebuilt.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE no_git)
if(no_git)
  set(commit "unknown")
endif()
execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no
  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(changes STREQUAL "")
  set(dirty false)
else()
  set(dirty true)
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT
"#pragma once
#define DIPTYCH_VERSION \"@VERSION@\"
#define DIPTYCH_COMMIT \"@commit@\"
#define DIPTYCH_DIRTY @dirty@
#define DIPTYCH_COMPILER \"@COMPILER@\"
#define DIPTYCH_FLAGS \"@FLAGS@\"
#define DIPTYCH_SOURCE_DIR \"@SOURCE@\"
#define DIPTYCH_BINARY_DIR \"@BINARY@\"
")
