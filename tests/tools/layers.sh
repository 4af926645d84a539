#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that no folder of libbreast includes what its CMakeLists.txt does not name: a folder may include its
# own headers, those of its DEPENDS, and of theirs. Prints one line a violation; exit 1 when there is any.
set -eu
cd "$(dirname "$0")/../.."

# "folder: folders it DEPENDS on", a line each; io's four libraries are one folder.
rules=$(for file in libbreast/*/CMakeLists.txt; do
  folder=$(basename "$(dirname "$file")")
  depends=$(grep -v '^ *#' "$file" | tr '\n)' '  ' | grep -oE 'DEPENDS( +[a-z_0-9]+)+' | sed 's/DEPENDS//' || true)
  echo "$folder:" $(echo $depends | tr ' ' '\n' | sed 's/^io_.*/io/' | sort -u | grep -v "^$folder$")
done)

# All folders that a list of folders leads to.
closure() {
  reached=" "
  while [ $# -gt 0 ]; do
    case "$reached" in
      *" $1 "*) shift ;;
      *)
        reached="$reached$1 "
        more=$(printf '%s\n' "$rules" | sed -n "s/^$1: *//p")
        shift
        set -- "$@" $more
        ;;
    esac
  done
  echo "$reached"
}

bad=0
for folder in libbreast/*/; do
  name=$(basename "$folder")
  [ -n "$(find "$folder" -name '*.?pp' -print -quit)" ] || continue
  if ! line=$(printf '%s\n' "$rules" | grep "^$name:"); then
    echo "libbreast/$name has no CMakeLists.txt"
    bad=1
    continue
  fi
  depends=$(closure ${line#*:})
  case "$depends" in *" $name "*)
    echo "libbreast/$name depends on itself: a cycle of DEPENDS"
    bad=1 ;;
  esac
  allowed=" $name $depends "
  # Lines like  path/file.cpp:12:#include "mesh/shape.hpp"
  violations=$(grep -rnE '^ *#include "[^"]+"' --include='*.hpp' --include='*.cpp' "$folder" |
    awk -v name="$name" -v allowed="$allowed" '{
      target = $0
      sub(/.*#include "/, "", target)
      sub(/["\/].*/, "", target)
      if (!index(allowed, " " target " ")) print $0 ": " name " may not include " target
    }')
  if [ -n "$violations" ]; then
    echo "$violations"
    bad=1
  fi
done

# One subject a file.
long=$(find libbreast tools tests -name '*.?pp' -exec wc -l {} + | awk '$2 != "total" && $1 > 600 { print $2 ": " $1 " lines, more than 600" }')
if [ -n "$long" ]; then
  echo "$long"
  bad=1
fi

# Third parties stay in .cpp files (Eigen apart) and in the headers those files alone share: the folders
# io/hdf5, io/volume, io/dicom, io/vtk, and NAME_impl.hpp.
foreign=$(grep -rnE '^ *#include <(hdf5|xraylib|vtk|itk|gdcm|opencv|CGAL|CLI|nlohmann|nlopt|cholmod|openssl|gtest)' --include='*.hpp' \
  libbreast | grep -vE '^libbreast/(io/(hdf5|volume|dicom|vtk)/|[a-z]+/[a-z_]+_impl\.hpp)' || true)
if [ -n "$foreign" ]; then
  echo "third party in a header: $foreign"
  bad=1
fi
exit $bad
