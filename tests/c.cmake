# The tests in C, with cmocka.

add_library(hooke_test_flags INTERFACE)
target_link_libraries(hooke_test_flags INTERFACE hooke_flags)
target_include_directories(hooke_test_flags INTERFACE ${PROJECT_SOURCE_DIR}/include support)
target_include_directories(hooke_test_flags SYSTEM INTERFACE ${HOOKE_CMOCKA_INCLUDE_DIR})
target_compile_definitions(hooke_test_flags INTERFACE
  HOOKE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ${HOOKE_HAVE_DEFINITIONS}
  HOOKE_CHECK_HANDLES=$<BOOL:${HOOKE_CHECK_HANDLES}>)

# A hundred programs are linked in half the time.
include(CheckLinkerFlag)
check_linker_flag(C -fuse-ld=gold HOOKE_HAS_GOLD)
if(HOOKE_HAS_GOLD)
  target_link_options(hooke_test_flags INTERFACE -fuse-ld=gold)
endif()

# Windows goes without the sources that use what POSIX alone has.
function(hooke_drop_foreign list)
  if(WIN32)
    foreach(source IN LISTS ${list})
      file(STRINGS ${source} foreign LIMIT_COUNT 1 REGEX
        "#include <(dirent|dlfcn|fcntl|locale|signal|spawn|sys/.*|unistd)\\.h>|#include \"(file_limit|held)\\.h\"")
      if(foreign)
        list(REMOVE_ITEM ${list} ${source})
      endif()
    endforeach()
    set(${list} ${${list}} PARENT_SCOPE)
  endif()
endfunction()

file(GLOB support_sources CONFIGURE_DEPENDS support/*.c)
hooke_drop_foreign(support_sources)
include(public_calls.cmake)
if(support_sources)
  add_library(hooke_test_support STATIC ${support_sources} ${public_calls})
  target_link_libraries(hooke_test_support PRIVATE hooke_test_flags)
  set_target_properties(hooke_test_support PROPERTIES C_EXTENSIONS ${HOOKE_EXTENSIONS})
endif()

# Tests of a unit see the insides and use the static library; the others use the shared one, as a user does. A suite in
# a suite (physics/extremes) has the label of the outer one too.
function(hooke_add_c_tests suite library)
  file(GLOB sources CONFIGURE_DEPENDS ${suite}/test_*.c)
  hooke_drop_foreign(sources)
  string(REPLACE "/" "_" prefix ${suite})
  string(REPLACE "/" ";" labels ${suite})
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM name)
    string(REGEX REPLACE "^test_" "" name ${name})
    set(target hooke_test_${prefix}_${name})
    add_executable(${target} ${source})
    target_link_libraries(${target} PRIVATE
      hooke_test_flags $<TARGET_NAME_IF_EXISTS:hooke_test_support> ${library} ${HOOKE_CMOCKA_LIBRARY} m)
    target_include_directories(${target} PRIVATE ${ARGN})
    set_target_properties(${target} PROPERTIES C_EXTENSIONS ${HOOKE_EXTENSIONS} OUTPUT_NAME ${prefix}_${name})
    hooke_add_test(${suite}/${name} ${target})
    set_tests_properties(${suite}/${name} PROPERTIES LABELS "${labels}" TIMEOUT ${HOOKE_TEST_TIMEOUT} ENVIRONMENT OPENBLAS_NUM_THREADS=1)
  endforeach()
endfunction()

hooke_add_c_tests(unit hooke_static ${PROJECT_SOURCE_DIR}/src)
# Loops of every instruction set in turn, in place of the best that the machine has.
target_link_options(hooke_test_unit_instruction_sets PRIVATE LINKER:--wrap=hk_spring_set)
# A file system where readers and runs share one kind of lock.
if(TARGET hooke_test_unit_output_lock)
  target_link_options(hooke_test_unit_output_lock PRIVATE LINKER:--wrap=flock)
endif()
# Sees how many threads are in HDF5.
target_link_options(hooke_test_unit_hdf5_alone PRIVATE LINKER:--wrap=H5Fopen)
get_property(unit_tests DIRECTORY PROPERTY BUILDSYSTEM_TARGETS)
list(FILTER unit_tests INCLUDE REGEX "^hooke_test_unit_")
add_custom_target(hooke_unit_tests DEPENDS ${unit_tests})
if(WIN32) # where a program finds the library beside itself
  add_executable(hooke_windows_states windows/states.c)
  add_executable(hooke_long_bits long/bits.c)
  target_link_libraries(hooke_long_bits PRIVATE hooke_test_flags hooke_test_support ${HOOKE_CMOCKA_LIBRARY})
  foreach(target hooke_windows_states hooke_long_bits)
    target_link_libraries(${target} PRIVATE hooke hooke_flags)
    set_target_properties(${target} PROPERTIES C_EXTENSIONS ON RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  endforeach()
  set_target_properties(hooke_windows_states PROPERTIES OUTPUT_NAME states)
  set_target_properties(hooke_long_bits PROPERTIES OUTPUT_NAME bits)
  return()
endif()
hooke_add_c_tests(physics hooke)
hooke_add_c_tests(physics/extremes hooke)
hooke_add_c_tests(determinism hooke)
hooke_add_c_tests(guest hooke)

# Inputs that fuzzing came across, with every sanitizer there is; and where lines are counted.
set(counted FALSE)
if(CMAKE_C_FLAGS MATCHES "--coverage")
  set(counted TRUE)
endif()
if(counted OR CMAKE_C_FLAGS MATCHES "-fsanitize")
  add_subdirectory(fuzz)
endif()
# Faults: what fails by plan stands in place of the system's functions.
hooke_add_c_tests(fault hooke_static)
file(GLOB fault_sources CONFIGURE_DEPENDS fault/scenario*.c)
add_library(hooke_fault_scenarios OBJECT ${fault_sources} fault/attempt.c fault/places.c fault/plan.c fault/sweep.c)
target_link_libraries(hooke_fault_scenarios PRIVATE hooke_test_flags)
target_compile_definitions(hooke_fault_scenarios PRIVATE HOOKE_HAVE_PROGRAM=$<BOOL:${HOOKE_BUILD_CLI}>)
set_target_properties(hooke_fault_scenarios PROPERTIES C_EXTENSIONS OFF)
# The program, as one more function.
if(HOOKE_BUILD_CLI)
  add_library(hooke_fault_program OBJECT ${HOOKE_CLI_SOURCES})
  target_link_libraries(hooke_fault_program PRIVATE hooke_flags)
  target_include_directories(hooke_fault_program PRIVATE ${PROJECT_SOURCE_DIR}/include ${HOOKE_CLI_FOLDERS})
  target_compile_definitions(hooke_fault_program PRIVATE main=hooke_program_main)
  target_compile_options(hooke_fault_program PRIVATE -include ${CMAKE_CURRENT_SOURCE_DIR}/fault/program.h)
  set_target_properties(hooke_fault_program PROPERTIES C_EXTENSIONS OFF)
endif()
foreach(test allocations process_allocations writes)
  target_sources(hooke_test_fault_${test} PRIVATE $<TARGET_OBJECTS:hooke_fault_scenarios>)
  target_link_options(hooke_test_fault_${test} PRIVATE LINKER:--wrap=hk_clock_seconds)
  if(HOOKE_BUILD_CLI)
    target_sources(hooke_test_fault_${test} PRIVATE $<TARGET_OBJECTS:hooke_fault_program>)
  endif()
endforeach()
target_sources(hooke_test_fault_writes PRIVATE fault/file_faults.c)
target_sources(hooke_test_fault_process_allocations PRIVATE fault/process_faults.c)
target_link_libraries(hooke_test_fault_process_allocations PRIVATE ${CMAKE_DL_LIBS})
target_compile_definitions(hooke_test_fault_process_allocations PRIVATE HOOKE_COUNTED=$<BOOL:${counted}>)
target_sources(hooke_test_fault_allocations PRIVATE fault/memory_faults.c)
target_link_libraries(hooke_test_fault_allocations PRIVATE ${HOOKE_DEPENDENCIES})
target_link_options(hooke_test_fault_allocations PRIVATE
  LINKER:--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=aligned_alloc,--wrap=free
  LINKER:--wrap=realpath,--wrap=strdup,--wrap=strndup,--wrap=open_memstream
  LINKER:--wrap=fopen,--wrap=pthread_create,--wrap=fsync)

if(HOOKE_LONG_TESTS)
  add_subdirectory(long)
endif()
