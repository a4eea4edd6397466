# SPDX-License-Identifier: BSD-3-Clause
# An overlay port for this source tree: vcpkg install pcl-mrf-planes
# --overlay-ports=packaging/vcpkg. Libraries only. It was never run by vcpkg itself, which Debian
# does not have; see packaging/README.md for what is tested.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DPCL_MRF_PLANES_APPS=OFF
    -DPCL_MRF_PLANES_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME pcl_mrf_planes
  CONFIG_PATH lib/cmake/pcl_mrf_planes)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
