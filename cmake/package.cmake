# SPDX-License-Identifier: GPL-3.0-or-later
# cpack -G DEB in build/package (preset `package`): libbreast_VERSION-1_ARCHITECTURE.deb. What the programs link is found by
# dpkg-shlibdeps; what the pipeline starts is named here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME libbreast)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "libbreast <libbreast@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "breast MR scan to mechanical model to mammogram")
set(CPACK_PACKAGE_DESCRIPTION "Tools that turn a prone breast MR scan into a mechanical model of the
breast: segmentation, a hexahedral mesh, the stress-free shape, the shape
under gravity in any posture, compression between mammography plates,
simulated mammograms, and the curve in one view on which a point of another
view lies.
.
The command breast runs each tool, and the whole chain on a scan or on a
phantom whose truth is known. This is research software: it is not
clinically validated and not a medical device.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Compile the Python package when it is installed, and remove what was compiled when it is removed.
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Recipes of make; the threaded OpenBLAS (the reference BLAS is 5-8 times slower); figures and pages are made by Python, the surfaces
# of figures on a private display.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "make, libopenblas0-pthread, xvfb, xauth, libgl1-mesa-dri, python3, python3-h5py, python3-jinja2, python3-matplotlib, python3-pil, python3-vtk9")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS bash-completion)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "slurm-client, chromium, python3-pandas, paraview")

# What Debian asks for beside the manual pages; no upload, so no bug of Debian's that it would close.
set(debian ${PROJECT_BINARY_DIR}/debian)
configure_file(cmake/debian/copyright ${debian}/copyright COPYONLY)
configure_file(cmake/debian/changelog.in ${debian}/changelog.Debian @ONLY)
find_program(GZIP_PROGRAM gzip REQUIRED)
execute_process(COMMAND ${GZIP_PROGRAM} -9nkf ${debian}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${debian}/libbreast "libbreast: initial-upload-closes-no-bugs *\n")
install(FILES ${debian}/libbreast DESTINATION share/lintian/overrides)
install(FILES ${debian}/copyright ${debian}/changelog.Debian.gz DESTINATION share/doc/libbreast)
include(CPack)
