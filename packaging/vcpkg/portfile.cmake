vcpkg_from_github(
  OUT_SOURCE_PATH SOURCE_PATH
  REPO OWNER/hooke
  REF "v${VERSION}"
  SHA512 0
)
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES hdf5 HOOKE_HDF5)
foreach(part SUNDIALS CHOLMOD LAPACK GSL CHARTJS THREEJS)
  list(APPEND features -DHOOKE_${part}=OFF)
endforeach()
vcpkg_find_acquire_program(PYTHON3)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DBUILD_TESTING=OFF -DHOOKE_BUILD_CLI=OFF "-DPython3_EXECUTABLE=${PYTHON3}"
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/hooke)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
if(VCPKG_LIBRARY_LINKAGE STREQUAL "dynamic") # both libraries are built then
  file(REMOVE "${CURRENT_PACKAGES_DIR}/lib/libhooke.a" "${CURRENT_PACKAGES_DIR}/debug/lib/libhooke.a"
    "${CURRENT_PACKAGES_DIR}/share/hooke/hooke-static.cmake")
endif()
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
