# The Debian package: `cd build/host && cpack`. What it depends on is found out by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME iogrid)
set(CPACK_PACKAGE_CONTACT "the iogrid authors <authors@iogrid.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "grids of free, standing and moving from lidar packets")
set(CPACK_PACKAGE_DESCRIPTION
  "iog simulates, fuses, replays, receives, shows and records the grids of a target that runs iogrid. With it come
readers of the target's stream for C (find_package(iogrid)) and Python (python3-numpy), and its documents.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, chromium, python3-distributed, wireshark, zstd")

include(CPack)
