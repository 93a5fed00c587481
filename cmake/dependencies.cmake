# Finds the optional libraries and makes imported targets hooke_dep::<name> of them. The build includes this file; so
# does the installed package, for the static library.

# hooke_find_library(<name> [HEADER <file>] LIBRARIES <a|b>... [OPTIONAL <a>...] [ARCHIVES <a>...] [SUFFIXES <dir>...]
#                    VERSION <file> <pattern>)
# Alternatives to a library name are separated by "|". Sets HOOKE_<NAME>_FOUND and HOOKE_<NAME>_VERSION.
# With HOOKE_STATIC_PARTS it finds only archives, and the further ones that they depend on (ARCHIVES).
function(hooke_find_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER" "LIBRARIES;OPTIONAL;ARCHIVES;SUFFIXES;VERSION")
  string(TOUPPER ${name} NAME)
  set(HOOKE_${NAME}_FOUND FALSE PARENT_SCOPE)

  set(folder)
  if(arg_HEADER)
    find_path(HOOKE_${NAME}_INCLUDE_DIR ${arg_HEADER} PATH_SUFFIXES ${arg_SUFFIXES})
    mark_as_advanced(HOOKE_${NAME}_INCLUDE_DIR)
    if(NOT HOOKE_${NAME}_INCLUDE_DIR)
      return()
    endif()
    set(folder "${HOOKE_${NAME}_INCLUDE_DIR}")
  endif()

  if(HOOKE_STATIC_PARTS)
    set(CMAKE_FIND_LIBRARY_SUFFIXES ${CMAKE_STATIC_LIBRARY_SUFFIX})
    list(APPEND arg_LIBRARIES ${arg_ARCHIVES})
  endif()
  set(files)
  foreach(names IN LISTS arg_LIBRARIES arg_OPTIONAL)
    string(MAKE_C_IDENTIFIER "HOOKE_LIBRARY_${names}" variable)
    string(REPLACE "|" ";" alternatives "${names}")
    find_library(${variable} NAMES ${alternatives} NAMES_PER_DIR PATH_SUFFIXES ${arg_SUFFIXES})
    mark_as_advanced(${variable})
    if(${variable})
      list(APPEND files "${${variable}}")
    elseif(NOT names IN_LIST arg_OPTIONAL)
      return()
    endif()
  endforeach()

  list(POP_FRONT arg_VERSION version_file version_pattern)
  cmake_path(ABSOLUTE_PATH version_file BASE_DIRECTORY "${folder}")
  set(version "")
  if(EXISTS "${version_file}")
    file(STRINGS "${version_file}" version REGEX "${version_pattern}" LIMIT_COUNT 1)
  endif()
  string(REGEX REPLACE ".*${version_pattern}.*" "\\1" version "${version}")
  if(version STREQUAL "")
    set(version unknown)
  endif()
  set(HOOKE_${NAME}_VERSION "${version}" PARENT_SCOPE)

  if(NOT TARGET hooke_dep::${name})
    add_library(hooke_dep::${name} INTERFACE IMPORTED GLOBAL)
    target_include_directories(hooke_dep::${name} INTERFACE "${folder}")
    target_link_libraries(hooke_dep::${name} INTERFACE ${files})
  endif()
  set(HOOKE_${NAME}_FOUND TRUE PARENT_SCOPE)
endfunction()

# OpenBLAS has LAPACK and BLAS in one library.
function(hooke_name_lapack)
  if(HOOKE_LAPACK_FOUND AND EXISTS "${HOOKE_LAPACK_VERSION_FILE}")
    file(STRINGS "${HOOKE_LAPACK_VERSION_FILE}" name REGEX "^Name:.*openblas")
    if(name)
      set(HOOKE_LAPACK_VERSION "${HOOKE_LAPACK_VERSION} (OpenBLAS)" PARENT_SCOPE)
    endif()
  endif()
endfunction()

# Scripts for browsers are those of this machine, whatever it compiles for.
set(HOOKE_SCRIPTS_OF_HOST PATHS /usr NO_CMAKE_FIND_ROOT_PATH)

# Chart.js is not linked: its bundle for browsers (chart.umd.js from version 4 on) goes into the pages of reports.
# Sets HOOKE_CHARTJS_FOUND, _FILE and _VERSION.
function(hooke_find_chartjs)
  set(HOOKE_CHARTJS_FOUND FALSE PARENT_SCOPE)
  find_file(HOOKE_CHARTJS_FILE NAMES chart.min.js chart.umd.js
    PATH_SUFFIXES share/javascript/chart.js share/nodejs/chart.js/dist ${HOOKE_SCRIPTS_OF_HOST})
  mark_as_advanced(HOOKE_CHARTJS_FILE)
  if(HOOKE_CHARTJS_FILE)
    file(READ "${HOOKE_CHARTJS_FILE}" banner LIMIT 400)
    if(banner MATCHES "Chart\\.js v([34]\\.[0-9.]+).*typeof exports")
      set(HOOKE_CHARTJS_VERSION ${CMAKE_MATCH_1} PARENT_SCOPE)
      set(HOOKE_CHARTJS_FOUND TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

# three.js likewise: the script that sets THREE, and OrbitControls as such a script beside it. Later versions have only
# modules, and no such scripts. Sets HOOKE_THREEJS_FOUND, _FILE, _ORBIT_FILE and _VERSION.
function(hooke_find_threejs)
  set(HOOKE_THREEJS_FOUND FALSE PARENT_SCOPE)
  set(folders share/javascript/three share/javascript/three/build share/nodejs/three/build)
  find_file(HOOKE_THREEJS_FILE NAMES three.min.js PATH_SUFFIXES ${folders} ${HOOKE_SCRIPTS_OF_HOST})
  find_file(HOOKE_THREEJS_ORBIT_FILE NAMES OrbitControls.js
    PATH_SUFFIXES share/javascript/three/examples/js/controls share/nodejs/three/examples/js/controls
    ${HOOKE_SCRIPTS_OF_HOST})
  mark_as_advanced(HOOKE_THREEJS_FILE HOOKE_THREEJS_ORBIT_FILE)
  if(HOOKE_THREEJS_FILE AND HOOKE_THREEJS_ORBIT_FILE)
    file(STRINGS "${HOOKE_THREEJS_FILE}" line REGEX "REVISION *= *\"[0-9]+" LIMIT_COUNT 1)
    if(line MATCHES "REVISION *= *\"([0-9]+)")
      set(HOOKE_THREEJS_VERSION ${CMAKE_MATCH_1} PARENT_SCOPE)
      set(HOOKE_THREEJS_FOUND TRUE PARENT_SCOPE)
    endif()
  endif()
endfunction()

# The header has the three numbers of the version on separate lines; from SuiteSparse 7 on it is cholmod.h.
function(hooke_read_cholmod_version)
  set(numbers)
  foreach(header cholmod_core.h cholmod.h)
    set(file "${HOOKE_CHOLMOD_INCLUDE_DIR}/${header}")
    if(EXISTS "${file}" AND NOT numbers)
      file(STRINGS "${file}" numbers REGEX "^#define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION +[0-9]+")
    endif()
  endforeach()
  list(TRANSFORM numbers REPLACE ".* " "")
  if(numbers)
    list(JOIN numbers "." version)
    set(HOOKE_CHOLMOD_VERSION "${version}" PARENT_SCOPE)
  endif()
endfunction()

# Versions from 6.4 on; the headers of 7 include mpi.h where SUNDIALS was built with MPI.
function(hooke_complete_sundials)
  if(NOT HOOKE_SUNDIALS_FOUND)
    return()
  endif()
  if(HOOKE_SUNDIALS_VERSION VERSION_LESS 6.4)
    message(STATUS "sundials ${HOOKE_SUNDIALS_VERSION}: too old, 6.4 or later is needed")
    set(HOOKE_SUNDIALS_FOUND FALSE PARENT_SCOPE)
  elseif(NOT HOOKE_SUNDIALS_VERSION VERSION_LESS 7)
    file(STRINGS "${HOOKE_SUNDIALS_INCLUDE_DIR}/sundials/sundials_config.h" mpi REGEX "^#define SUNDIALS_MPI_ENABLED 1")
    if(mpi)
      find_package(MPI QUIET COMPONENTS C)
      target_include_directories(hooke_dep::sundials INTERFACE ${MPI_C_INCLUDE_DIRS})
      target_link_libraries(hooke_dep::sundials INTERFACE ${MPI_C_LIBRARIES}) # files, for pkg-config too
    endif()
  endif()
endfunction()

# The packages of SUNDIALS and HDF5 in distributions come with MPI, PETSc and more in their CMake files, so these are
# looked up by name. One of them ("sundials", "cholmod", "lapack", "gsl", "hdf5") per call.
macro(hooke_find name)
  if("${name}" STREQUAL "sundials")
    hooke_find_library(sundials
      HEADER cvode/cvode.h
      LIBRARIES sundials_cvode sundials_arkode sundials_nvecserial sundials_sunlinsolspgmr
                sundials_sunnonlinsolnewton sundials_sunnonlinsolfixedpoint
      OPTIONAL sundials_core # SUNDIALS 7
      VERSION sundials/sundials_config.h "SUNDIALS_VERSION \"([^\"]+)\"")
    hooke_complete_sundials()
  elseif("${name}" STREQUAL "cholmod")
    hooke_find_library(cholmod
      HEADER cholmod.h
      LIBRARIES cholmod
      SUFFIXES suitesparse
      VERSION cholmod.h "no line has all of it")
    hooke_read_cholmod_version()
  elseif("${name}" STREQUAL "lapack") # of Fortran: no header
    find_file(HOOKE_LAPACK_VERSION_FILE lapack.pc
      PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/pkgconfig lib/pkgconfig share/pkgconfig)
    mark_as_advanced(HOOKE_LAPACK_VERSION_FILE)
    hooke_find_library(lapack
      LIBRARIES lapack
      ARCHIVES "blas|lapack" # one archive may have both
      VERSION "${HOOKE_LAPACK_VERSION_FILE}" "^Version: *([^ ]+)")
    hooke_name_lapack()
  elseif("${name}" STREQUAL "gsl")
    hooke_find_library(gsl
      HEADER gsl/gsl_version.h
      LIBRARIES gsl gslcblas
      VERSION gsl/gsl_version.h "GSL_VERSION \"([^\"]+)\"")
  elseif("${name}" STREQUAL "hdf5")
    hooke_find_library(hdf5 # the serial one
      HEADER hdf5.h
      LIBRARIES "hdf5_serial|hdf5"
      ARCHIVES z
      SUFFIXES hdf5/serial
      VERSION H5public.h "H5_VERS_INFO +\"HDF5 library version:? ([^\"]+)\"")
  elseif("${name}" STREQUAL "chartjs")
    hooke_find_chartjs()
  elseif("${name}" STREQUAL "threejs")
    hooke_find_threejs()
  endif()
endmacro()
