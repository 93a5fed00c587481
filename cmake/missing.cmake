# Prints one line about the libraries that are missing; with HOOKE_EVERYTHING this is an error.
option(HOOKE_EVERYTHING "Demand every library that is not OFF, and all that the tests need" OFF)

function(hooke_missing_words words)
  if(HOOKE_EVERYTHING)
    message(FATAL_ERROR "${words}")
  endif()
  message(STATUS "${words}")
endfunction()

# Names are those of packages.txt.
function(hooke_missing name consequence)
  file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/packages.txt row REGEX "^${name} ")
  string(REGEX MATCHALL "[^ ]+" row "${row}")
  set(ways)
  foreach(command IN ITEMS "apt-get install" "dnf install" "brew install")
    list(POP_FRONT row _)
    list(GET row 0 package)
    if(NOT package STREQUAL "-")
      list(APPEND ways "${command} ${package}")
    endif()
  endforeach()
  list(JOIN ways ", " ways)
  set(space " ")
  if(HOOKE_EVERYTHING)
    set(space "\n  ") # a line that CMake leaves as it is
  endif()
  hooke_missing_words("${name}: not found, ${consequence}:${space}${ways}")
endfunction()
