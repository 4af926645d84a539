# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install build/release --prefix P: P/bin/breast, its tools in P/libexec/breast, the pipeline in P/share/breast. Everything
# finds everything else by its place below P, so that P may be moved.
get_property(programs GLOBAL PROPERTY BREAST_TOOLS)
get_property(launchers GLOBAL PROPERTY BREAST_LAUNCHERS)
# A tool that was not built (tetrahedra is not among `programs`) is left out; a launcher is written by install_python.cmake.
set(binaries ${programs})
foreach(launcher ${launchers})
  string(REGEX REPLACE "=.*" "" name ${launcher})
  list(REMOVE_ITEM binaries ${name})
endforeach()
install(TARGETS ${binaries} DESTINATION libexec/breast OPTIONAL)
install(FILES Makefile.pipeline DESTINATION share/breast)
install(DIRECTORY pipelines/ DESTINATION share/breast/pipelines USE_SOURCE_PERMISSIONS
  PATTERN ".*" EXCLUDE PATTERN setup.sh EXCLUDE PATTERN packages.txt EXCLUDE)
file(WRITE ${PROJECT_BINARY_DIR}/installed.mk "# An installation: its programs stand here, and nothing is built.\n"
  "INSTALLED := $(abspath $(ROOT)../../libexec/breast)\n")
install(FILES ${PROJECT_BINARY_DIR}/installed.mk DESTINATION share/breast/pipelines)
install(FILES ${PROJECT_BINARY_DIR}/tools.tsv DESTINATION share/breast)

install(FILES tools/breast.bash DESTINATION share/bash-completion/completions RENAME breast)
install(FILES README.md CITATION.cff DESTINATION share/doc/libbreast)
install(DIRECTORY docs DESTINATION share/doc/libbreast PATTERN man EXCLUDE PATTERN api EXCLUDE)
install(CODE "set(source \"${PROJECT_SOURCE_DIR}/python\")
set(PROJECT_VERSION ${PROJECT_VERSION})
set(launchers \"${launchers}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/install_python.cmake\")")
install(CODE "set(tools ${programs})
set(pages \"${PROJECT_SOURCE_DIR}/docs/man\")
set(destination \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1\")
include(\"${PROJECT_SOURCE_DIR}/cmake/install_man.cmake\")")
