# SPDX-License-Identifier: GPL-3.0-or-later
# At installation: the package `source`/breast into a folder of the prefix in which /usr/bin/python3 looks for packages, if it has one
# (/usr, /usr/local, ~/.local), otherwise into lib/python3/dist-packages; and the `launchers` NAME=MODULE, which find it from their place.
set(default lib/python3/dist-packages)
execute_process(COMMAND /usr/bin/python3 -c "
import site, sys
lib = sys.argv[1].rstrip('/') + '/lib/'
found = [f for f in [site.getusersitepackages(), *site.getsitepackages()] if f.startswith(lib)]
print('lib/' + found[0][len(lib):] if found else '', end='')" ${CMAKE_INSTALL_PREFIX}
  OUTPUT_VARIABLE folder RESULT_VARIABLE failed ERROR_QUIET)
if(failed OR folder STREQUAL "")
  set(folder ${default})
  if(NOT CMAKE_INSTALL_PREFIX MATCHES "/_CPack_Packages/")
    message(STATUS "import breast: export PYTHONPATH=${CMAKE_INSTALL_PREFIX}/${folder}")
  endif()
endif()
set(root "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")
file(INSTALL ${source}/breast DESTINATION ${CMAKE_INSTALL_PREFIX}/${folder} FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "*.jinja"
  PATTERN "*.css" PATTERN "*.js" PATTERN "*.tsv" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
foreach(launcher ${launchers})
  string(REGEX REPLACE "=.*" "" name ${launcher})
  string(REGEX REPLACE ".*=" "" module ${launcher})
  set(place libexec/breast)
  if(name STREQUAL "breast")
    set(place bin)
  endif()
  file(RELATIVE_PATH python ${CMAKE_INSTALL_PREFIX}/${place} ${CMAKE_INSTALL_PREFIX}/${folder})
  configure_file(${source}/launcher.py.in ${root}/${place}/${name} @ONLY
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  message(STATUS "Installing: ${root}/${place}/${name}")
endforeach()
# Compiled here, because who starts a program may not write beside it. The Debian package does it on the user's machine.
if(NOT root MATCHES "/_CPack_Packages/")
  execute_process(COMMAND /usr/bin/python3 -m compileall -q -s "$ENV{DESTDIR}" ${root}/${folder}/breast)
endif()
