# A Debian package of the program, its scripts and scenes, and the Python package: tools/package.sh makes it. Headers and
# libraries are no part of it, for they ask for a Kokkos that Debian 12 does not have.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME skein)
set(CPACK_PACKAGE_CONTACT "the skein developers <skein@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "long, flexible, elastic fibers in viscous flow")
set(CPACK_PACKAGE_DESCRIPTION
  "Simulates fibers as tubes of nodes joined by springs, in a fluid that answers by regularized Stokeslets, summed directly
or by a kernel-independent fast multipole method; measures and draws what they did.")
set(CPACK_COMPONENTS_ALL program python)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-h5py, python3-matplotlib, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libjs-three")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, paraview, python3-scipy")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/postinst;${PROJECT_SOURCE_DIR}/cmake/debian/prerm")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
set(CPACK_STRIP_FILES ON)
include(CPack)
