# Writes the commit and the compiler into HEADER, at each build, and touches it only if they changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define BENCH_COMMIT \"${commit}\"\n#define BENCH_COMPILER \"${COMPILER}\"\n")
