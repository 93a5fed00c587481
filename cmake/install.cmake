# cmake --install: headers, both libraries, the program with its manual page and completions, the example scenes, the pages
# of reports, the sources of the Fortran module, and the files by which find_package(hooke) and pkg-config find them.
# No installed file names a folder of this machine, so the result can be moved, if no folder is given in full.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hooke)

install(FILES include/hooke.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/hooke DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY examples/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/hooke/examples)
if(HOOKE_CHARTJS_FOUND)
  install(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/share/hooke/ DESTINATION ${CMAKE_INSTALL_DATADIR}/hooke)
endif()
set(HOOKE_FORTRAN_DIR ${CMAKE_INSTALL_DATADIR}/hooke/fortran)
if(HOOKE_FORTRAN_SOURCES)
  install(DIRECTORY bindings/fortran/ ${PROJECT_BINARY_DIR}/fortran/ DESTINATION ${HOOKE_FORTRAN_DIR}
    FILES_MATCHING PATTERN "*.f90" PATTERN sources.txt PATTERN "*.template.f90" EXCLUDE)
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_BINARY_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL) # where `make docs` has made them

# There are two sets of targets, since only the static library needs the other libraries to be found.
if(TARGET hooke)
  install(TARGETS hooke EXPORT hooke_shared_targets)
  install(EXPORT hooke_shared_targets FILE hooke-shared.cmake NAMESPACE hooke:: DESTINATION ${config_dir})
endif()
install(TARGETS hooke_static EXPORT hooke_static_targets)
install(EXPORT hooke_static_targets FILE hooke-static.cmake NAMESPACE hooke:: DESTINATION ${config_dir})

if(HOOKE_BUILD_CLI)
  file(RELATIVE_PATH to_library ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set(own_folder "$ORIGIN")
  if(APPLE)
    set(own_folder @loader_path)
  endif()
  set_target_properties(hooke_cli PROPERTIES INSTALL_RPATH "${own_folder}/${to_library}")
  install(TARGETS hooke_cli)
endif()
if(HOOKE_PAGES_OF_CLI)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke.bash
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hooke)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke.zsh
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _hooke)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke.fish
    DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()

configure_package_config_file(cmake/hooke-config.cmake.in hooke-config.cmake INSTALL_DESTINATION ${config_dir}
  PATH_VARS HOOKE_FORTRAN_DIR)
write_basic_package_version_file(hooke-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/hooke-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/hooke-config-version.cmake
  cmake/dependencies.cmake
  cmake/fortran.cmake
  DESTINATION ${config_dir})

# The libraries that the static library needs, as -L and -l.
set(HOOKE_PRIVATE_LIBRARIES "-lm")
if(CMAKE_DL_LIBS)
  string(APPEND HOOKE_PRIVATE_LIBRARIES " -l${CMAKE_DL_LIBS}")
endif()
if(CMAKE_THREAD_LIBS_INIT)
  string(APPEND HOOKE_PRIVATE_LIBRARIES " ${CMAKE_THREAD_LIBS_INIT}")
endif()
foreach(dependency IN LISTS HOOKE_DEPENDENCIES)
  get_target_property(files ${dependency} INTERFACE_LINK_LIBRARIES)
  foreach(file IN LISTS files)
    cmake_path(GET file PARENT_PATH folder)
    cmake_path(GET file STEM LAST_ONLY name)
    string(REGEX REPLACE "^lib" "" name ${name})
    if(NOT folder IN_LIST CMAKE_C_IMPLICIT_LINK_DIRECTORIES)
      string(APPEND HOOKE_PRIVATE_LIBRARIES " -L${folder}")
    endif()
    string(APPEND HOOKE_PRIVATE_LIBRARIES " -l${name}")
  endforeach()
endforeach()
if(NOT TARGET hooke) # the static library alone
  set(HOOKE_PUBLIC_LIBRARIES " ${HOOKE_PRIVATE_LIBRARIES}")
endif()
file(RELATIVE_PATH to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(HOOKE_PC_PREFIX "\${pcfiledir}/${to_prefix}")
foreach(folder INCLUDEDIR DATADIR)
  set(HOOKE_PC_${folder} "\${prefix}/${CMAKE_INSTALL_${folder}}")
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${folder}}")
    set(HOOKE_PC_${folder} "${CMAKE_INSTALL_${folder}}")
  endif()
endforeach()
list(TRANSFORM HOOKE_FORTRAN_SOURCES PREPEND "\${fortrandir}/")
list(JOIN HOOKE_FORTRAN_SOURCES " " HOOKE_FORTRAN_SOURCES)
configure_file(cmake/hooke.pc.in hooke.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
