# SPDX-License-Identifier: GPL-3.0-or-later
# breast_launcher(NAME MODULE): the program NAME is the function main() of the Python module MODULE: a script of a few lines, in the
# build bin/NAME with the package of the source tree, and installed with the package beside it. It is a tool like those of C++ unless
# it is the command `breast` itself. Its time is that of the newest file in the module's folder, so that make repeats what a changed
# program has made.
function(breast_launcher name module)
  set(python ${PROJECT_SOURCE_DIR}/python)
  set(script ${PROJECT_BINARY_DIR}/launchers/${name})
  configure_file(${PROJECT_SOURCE_DIR}/python/launcher.py.in ${script} @ONLY
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  # An output of the build, so that ninja does not remove it as left over from a program of C++ with this name.
  set(output ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${name})
  string(REGEX REPLACE "[.][^.]*$" "" folder ${module})
  string(REPLACE "." "/" folder ${folder})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${python}/${folder}/*)
  if(folder MATCHES "^breast/(study|figures)$")  # and the kinds and figures that only the source tree has
    file(GLOB_RECURSE validation CONFIGURE_DEPENDS ${python}/breast_validation/*)
    list(APPEND sources ${validation})
  endif()
  list(FILTER sources EXCLUDE REGEX "/__pycache__/")
  add_custom_command(OUTPUT ${output} DEPENDS ${script} ${sources} COMMAND ${CMAKE_COMMAND} -E copy ${script} ${output}
    COMMAND ${CMAKE_COMMAND} -E touch ${output} VERBATIM)
  add_custom_target(${name} ALL DEPENDS ${output})
  set_property(GLOBAL APPEND PROPERTY BREAST_LAUNCHERS ${name}=${module})
  if(NOT name STREQUAL "breast")
    set_property(GLOBAL APPEND PROPERTY BREAST_TOOLS ${name})
  endif()
endfunction()

# The version has its home in project(); the package states it because it also works without a build.
file(STRINGS ${PROJECT_SOURCE_DIR}/python/breast/__init__.py version REGEX "^__version__ = ")
if(NOT version STREQUAL "__version__ = \"${PROJECT_VERSION}\"")
  message(FATAL_ERROR "python/breast/__init__.py says ${version}, and the project is ${PROJECT_VERSION}")
endif()
