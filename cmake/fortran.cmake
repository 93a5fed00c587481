# hooke::fortran: the module `hooke`, compiled by the Fortran compiler of the project that wants it, since no compiler
# reads the module files of another. `folder` holds the sources, in the order of its sources.txt.
function(hooke_add_fortran folder)
  file(STRINGS ${folder}/sources.txt sources)
  list(TRANSFORM sources PREPEND ${folder}/)
  add_library(hooke_fortran STATIC EXCLUDE_FROM_ALL ${sources})
  add_library(hooke::fortran ALIAS hooke_fortran)
  set(modules ${CMAKE_CURRENT_BINARY_DIR}/hooke_fortran_modules)
  set_target_properties(hooke_fortran PROPERTIES Fortran_MODULE_DIRECTORY ${modules} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(hooke_fortran INTERFACE ${modules})
  target_link_libraries(hooke_fortran PUBLIC hooke::hooke)
  # Objects may be shared by threads: with OpenMP, names of an object are counted by one thread at a time.
  if(TARGET OpenMP::OpenMP_Fortran)
    target_link_libraries(hooke_fortran PRIVATE OpenMP::OpenMP_Fortran)
  endif()
endfunction()
