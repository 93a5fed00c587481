# public_calls.inc, a table of the public functions, which support/public_calls.c includes. In `public_calls`.
set(public_calls ${CMAKE_CURRENT_BINARY_DIR}/generated/public_calls.inc)
set(generate ${PROJECT_SOURCE_DIR}/bindings/generate)
set(script ${CMAKE_CURRENT_LIST_DIR}/support/public_calls.py)
add_custom_command(OUTPUT ${public_calls}
  COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${generate} ${Python3_EXECUTABLE} -B ${script} ${public_calls}
  DEPENDS ${script} ${generate}/guard.py ${generate}/headers.py ${HOOKE_PUBLIC_HEADERS} VERBATIM)
include_directories(${CMAKE_CURRENT_BINARY_DIR}/generated)
