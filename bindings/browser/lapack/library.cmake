# The eigenvalues of LAPACK, translated by f2c (Debian's), which needs no Fortran compiler for the machine they are for.
find_program(HOOKE_F2C f2c)
find_file(HOOKE_F2C_HEADER f2c.h PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH)
mark_as_advanced(HOOKE_F2C HOOKE_F2C_HEADER)
set(HOOKE_LAPACK_HERE ${CMAKE_CURRENT_LIST_DIR})

# hooke_add_lapack(<target> <folder of LAPACK's sources> <folder for what is made> [<what brings the sources>])
function(hooke_add_lapack target sources made)
  file(COPY ${HOOKE_F2C_HEADER} DESTINATION ${made}) # out of the folder with the headers of this machine's C library
  find_package(Python3 3.8 REQUIRED COMPONENTS Interpreter)
  add_custom_command(OUTPUT ${made}/lapack.c
    COMMAND ${Python3_EXECUTABLE} -B ${HOOKE_LAPACK_HERE}/translate.py ${HOOKE_F2C} ${sources} ${made}/lapack.c
    DEPENDS ${HOOKE_LAPACK_HERE}/translate.py ${ARGN} VERBATIM)
  add_library(${target} STATIC ${made}/lapack.c ${HOOKE_LAPACK_HERE}/rest.c)
  target_include_directories(${target} PRIVATE ${made})
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  set_property(SOURCE ${made}/lapack.c PROPERTY COMPILE_OPTIONS -w)
endfunction()
