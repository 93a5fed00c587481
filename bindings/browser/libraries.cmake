# The libraries of the playground and of Windows, compiled for them from sources that Debian distributes. An archive is
# downloaded once: what is in build/downloads and has the right checksum is taken.
set(HOOKE_POOL http://deb.debian.org/debian/pool/main CACHE STRING "Debian's archives")
mark_as_advanced(HOOKE_POOL)

# hooke_source(<folder of the pool> <archive> <sha256>) leaves the sources in build/<preset>/sources.
function(hooke_source folder archive sum)
  set(file ${PROJECT_SOURCE_DIR}/build/downloads/${archive})
  file(DOWNLOAD ${HOOKE_POOL}/${folder}/${archive} ${file} EXPECTED_HASH SHA256=${sum})
  file(ARCHIVE_EXTRACT INPUT ${file} DESTINATION ${PROJECT_BINARY_DIR}/sources)
endfunction()

# Without f2c predictions are not built.
include(${CMAKE_CURRENT_LIST_DIR}/lapack/library.cmake)
if(HOOKE_F2C AND HOOKE_F2C_HEADER)
  hooke_source(l/lapack lapack_3.11.0.orig.tar.gz 4b9ba79bfd4921ca820e83979db76ab3363155709444a787979e81c22285ffa9)
  set(lapack ${PROJECT_BINARY_DIR}/f2c)
  hooke_add_lapack(hooke_lapack ${PROJECT_BINARY_DIR}/sources/lapack-3.11.0 ${lapack})
  file(WRITE ${lapack}/lapack.pc "Version: 3.11.0\n")
  set(HOOKE_LAPACK_VERSION_FILE ${lapack}/lapack.pc CACHE FILEPATH "" FORCE)
  set(HOOKE_LIBRARY_lapack hooke_lapack CACHE STRING "" FORCE)
  mark_as_advanced(HOOKE_LAPACK_VERSION_FILE HOOKE_LIBRARY_lapack)
endif()

# The tests in C run under Windows, too.
if(WIN32 AND HOOKE_BUILD_TESTS)
  hooke_source(c/cmocka cmocka_1.1.5.orig.tar.xz f0ccd8242d55e2fd74b16ba518359151f6f8383ff8aef4976e48393f77bba8b6)
  set(cmocka ${PROJECT_BINARY_DIR}/sources/cmocka-1.1.5)
  add_library(hooke_cmocka STATIC ${cmocka}/src/cmocka.c)
  target_include_directories(hooke_cmocka PRIVATE ${cmocka}/include)
  target_compile_definitions(hooke_cmocka PRIVATE HAVE_SIGNAL_H)
  target_compile_options(hooke_cmocka PRIVATE -w)
  set(HOOKE_CMOCKA_INCLUDE_DIR ${cmocka}/include CACHE PATH "" FORCE)
  set(HOOKE_CMOCKA_LIBRARY hooke_cmocka CACHE STRING "" FORCE)
endif()
