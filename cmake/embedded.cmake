# SPDX-License-Identifier: GPL-3.0-or-later
# breast_embedded_tables(FOLDER HEADER FUNCTION): writes embedded.cpp into the current binary folder, with the tables
# FOLDER/*.tsv as the result of FUNCTION, which HEADER declares.
function(breast_embedded_tables folder header function)
  file(GLOB tables CONFIGURE_DEPENDS ${folder}/*.tsv)
  list(SORT tables)
  set(entries "")
  foreach(table ${tables})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table})
    get_filename_component(name ${table} NAME_WE)
    file(READ ${table} text)
    string(APPEND entries "      {\"${name}\", R\"table(${text})table\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp @ONLY CONTENT
"#include \"@header@\"

namespace breast {

const std::vector<EmbeddedTable>& @function@() {
  static const std::vector<EmbeddedTable> tables = {
@entries@  };
  return tables;
}

}  // namespace breast
")
endfunction()
