# The headers; @HOLDFAST_…@ is filled in by tools/package recipes (.github/workflows/release.yml).
set(VCPKG_BUILD_TYPE release)

vcpkg_download_distfile(archive
  URLS "https://github.com/@HOLDFAST_REPOSITORY@/releases/download/v${VERSION}/holdfast-${VERSION}.tar.gz"
  FILENAME "holdfast-${VERSION}.tar.gz"
  SHA512 @HOLDFAST_SHA512@)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DHOLDFAST_BUILD_COMPILED=OFF
    -DHOLDFAST_BUILD_PROGRAM=OFF
    -DHOLDFAST_BUILD_TESTS=OFF
    -DHOLDFAST_WITH_CERES=OFF
    -DHOLDFAST_WITH_SIMD=OFF
    -DHOLDFAST_WITH_SUNDIALS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/holdfast)
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/doc" "${CURRENT_PACKAGES_DIR}/share/cmake")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
