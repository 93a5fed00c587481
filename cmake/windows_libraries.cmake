# SUNDIALS and HDF5 for Windows, compiled from Debian's sources when CMake is configured, once for a build tree; zlib is in
# Debian's libz-mingw-w64-dev. HDF5 runs programs of its own while it is configured, by wine.
set(HOOKE_INSTALLED ${PROJECT_BINARY_DIR}/installed CACHE PATH "Where they are or will be")
mark_as_advanced(HOOKE_INSTALLED)
set(ENV{WINEPREFIX} ${PROJECT_BINARY_DIR}/wine)
set(ENV{WINEDEBUG} -all)
list(PREPEND CMAKE_FIND_ROOT_PATH ${HOOKE_INSTALLED})

# hooke_install(<name> <folder of the sources> <option of CMake>...)
function(hooke_install name folder)
  if(EXISTS ${HOOKE_INSTALLED}/${name}.log)
    return()
  endif()
  message(STATUS "${name}: being compiled")
  set(build ${PROJECT_BINARY_DIR}/sources/${name})
  file(MAKE_DIRECTORY ${build} ${HOOKE_INSTALLED})
  execute_process(WORKING_DIRECTORY ${build} OUTPUT_FILE ${build}/log ERROR_FILE ${build}/log COMMAND_ERROR_IS_FATAL ANY
    COMMAND ${CMAKE_COMMAND} -S ${PROJECT_BINARY_DIR}/sources/${folder} -B . -G Ninja -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_TOOLCHAIN_FILE=${CMAKE_TOOLCHAIN_FILE} -DCMAKE_INSTALL_PREFIX=${HOOKE_INSTALLED} -DCMAKE_INSTALL_LIBDIR=lib
      -DCMAKE_C_COMPILER_LAUNCHER=${CMAKE_C_COMPILER_LAUNCHER} -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF ${ARGN})
  execute_process(WORKING_DIRECTORY ${build} OUTPUT_FILE ${build}/log ERROR_FILE ${build}/log COMMAND_ERROR_IS_FATAL ANY
    COMMAND ${CMAKE_COMMAND} --build . --target install)
  file(COPY_FILE ${build}/log ${HOOKE_INSTALLED}/${name}.log)
endfunction()

if(NOT "${HOOKE_SUNDIALS}" STREQUAL "OFF")
  hooke_source(s/sundials sundials_7.1.1+dfsg1.orig.tar.xz 8ed409272af77e958d0ac02fd72199d8643063faf2aa61811e5c615d7db5cf8e)
  hooke_install(sundials sundials-7.1.1 -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_INSTALL=OFF -DBUILD_CVODES=OFF -DBUILD_IDA=OFF
    -DBUILD_IDAS=OFF -DBUILD_KINSOL=OFF)
endif()

# HDF5 takes a system with <unistd.h> for one with <sys/wait.h>.
if(NOT "${HOOKE_HDF5}" STREQUAL "OFF" AND CMAKE_CROSSCOMPILING_EMULATOR)
  hooke_source(h/hdf5 hdf5_1.10.8+repack1.orig.tar.gz 7b38e58ff83b13fd8959a90b13bf896bc318ba096c940ab0847abf3ad41a0b31)
  hooke_install(hdf5 hdf5-1.10.8+repack1 -DBUILD_STATIC_LIBS=ON -DHDF5_BUILD_TOOLS=OFF -DHDF5_BUILD_EXAMPLES=OFF
    -DHDF5_BUILD_HL_LIB=OFF -DHDF5_BUILD_CPP_LIB=OFF -DHDF5_BUILD_FORTRAN=OFF -DHDF5_BUILD_UTILS=OFF
    -DHDF5_ENABLE_SZIP_SUPPORT=OFF -DHDF5_ENABLE_Z_LIB_SUPPORT=ON -DZLIB_USE_EXTERNAL=OFF
    -DZLIB_LIBRARY=/usr/x86_64-w64-mingw32/lib/libz.a -DH5_HAVE_UNISTD_H:INTERNAL=0)
endif()
set(HOOKE_LIBRARY_blas_lapack hooke_lapack CACHE STRING "" FORCE) # which has what it needs of BLAS
mark_as_advanced(HOOKE_LIBRARY_blas_lapack)
