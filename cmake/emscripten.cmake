# Compiles to WebAssembly with emscripten: its own file for CMake, below the compiler that is in PATH.
find_program(HOOKE_EMCC emcc REQUIRED)
mark_as_advanced(HOOKE_EMCC)
file(REAL_PATH ${HOOKE_EMCC} HOOKE_EMSCRIPTEN)
cmake_path(GET HOOKE_EMSCRIPTEN PARENT_PATH HOOKE_EMSCRIPTEN)
include(${HOOKE_EMSCRIPTEN}/cmake/Modules/Platform/Emscripten.cmake)

# Its compiler is a script around clang, which costs more than most files do: they are compiled by clang with its flags.
string(REGEX MATCH "^[0-9]+" HOOKE_CLANG_VERSION "${CMAKE_C_COMPILER_VERSION}")
find_program(HOOKE_CLANG clang-${HOOKE_CLANG_VERSION})
mark_as_advanced(HOOKE_CLANG)
if(HOOKE_CLANG)
  execute_process(COMMAND ${HOOKE_EMCC} --cflags OUTPUT_VARIABLE HOOKE_EMCC_FLAGS OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  set(CMAKE_C_COMPILE_OBJECT "${HOOKE_CLANG} ${HOOKE_EMCC_FLAGS} <DEFINES> <INCLUDES> <FLAGS> -o <OBJECT> -c <SOURCE>")
endif()
