# The libraries of the playground, compiled for it from sources that Debian distributes. An archive is downloaded once:
# what is in build/downloads and has the right checksum is taken.
set(HOOKE_POOL http://deb.debian.org/debian/pool/main CACHE STRING "Debian's archives")
mark_as_advanced(HOOKE_POOL)

# hooke_source(<folder of the pool> <archive> <sha256>) leaves the sources in build/<preset>/sources.
function(hooke_source folder archive sum)
  set(file ${PROJECT_SOURCE_DIR}/build/downloads/${archive})
  file(DOWNLOAD ${HOOKE_POOL}/${folder}/${archive} ${file} EXPECTED_HASH SHA256=${sum})
  file(ARCHIVE_EXTRACT INPUT ${file} DESTINATION ${PROJECT_BINARY_DIR}/sources)
endfunction()

# Its settings for Android are right for any system with the headers of POSIX.
hooke_source(j/jansson jansson_2.14.orig.tar.gz c739578bf6b764aa0752db9a2fdadcfe921c78f1228c7ec0bb47fa804c55d17b)
set(jansson ${PROJECT_BINARY_DIR}/sources/jansson-2.14)
file(COPY ${jansson}/android/jansson_config.h DESTINATION ${jansson}/src)
file(TOUCH ${jansson}/src/jansson_private_config.h)
file(GLOB sources ${jansson}/src/*.c)
add_library(jansson STATIC ${sources})
target_include_directories(jansson PRIVATE ${jansson}/src)
target_compile_definitions(jansson PRIVATE HAVE_STDINT_H HAVE_SYS_TYPES_H)
set(HOOKE_JANSSON_INCLUDE_DIR ${jansson}/src CACHE PATH "")
set(HOOKE_LIBRARY_jansson jansson CACHE STRING "")
mark_as_advanced(HOOKE_JANSSON_INCLUDE_DIR HOOKE_LIBRARY_jansson)
