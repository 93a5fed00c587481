# Compiles to WebAssembly with emscripten: its own file for CMake, below the compiler that is in PATH.
find_program(HOOKE_EMCC emcc REQUIRED)
mark_as_advanced(HOOKE_EMCC)
file(REAL_PATH ${HOOKE_EMCC} HOOKE_EMSCRIPTEN)
cmake_path(GET HOOKE_EMSCRIPTEN PARENT_PATH HOOKE_EMSCRIPTEN)
include(${HOOKE_EMSCRIPTEN}/cmake/Modules/Platform/Emscripten.cmake)
