#!/bin/sh
# Checks that no folder of libbreast includes what its layer may not. Prints one line a violation; exit 1 when there is any.
set -eu
cd "$(dirname "$0")/../.."

# folder: folders whose headers it may include (its own is always allowed). No cycles: each line names
# only folders with a line above or of a lower layer.
rules="
core:
dicom: core
image: core
surface: core
material: core
mesh: surface core
views: core
projection: views mesh image surface core
matching: projection views mesh image surface core
align: matching projection views dicom mesh image surface core
xray: projection views mesh image surface core
page: matching projection views mesh image surface core
cli: core
io: core dicom image surface mesh views projection matching
segment: image surface core
fit: surface image core
meshing: mesh surface image core
tetrahedra: mesh surface core
fem: material mesh core
solve: core
mechanics: fem material mesh solve surface core
contact: views mechanics fem material mesh solve surface core
deck: mechanics material mesh solve core
sensitivity: contact views mechanics fem material mesh solve surface core
phantom: mechanics fem material mesh solve surface image core
calibration: phantom mechanics fem material mesh solve surface image core
figures: mesh views projection surface image core
evaluation: mesh surface image core
"

bad=0
for folder in libbreast/*/; do
  name=$(basename "$folder")
  [ -n "$(find "$folder" -name '*.?pp' -print -quit)" ] || continue
  if ! line=$(printf '%s' "$rules" | grep "^$name:"); then
    echo "libbreast/$name has no rule in tests/tools/layers.sh"
    bad=1
    continue
  fi
  allowed=" $name ${line#*:} "
  # Lines like  path/file.cpp:12:#include "mesh/shape.hpp"
  includes=$(grep -rnE '^ *#include "[^"]+"' --include='*.hpp' --include='*.cpp' "$folder" || true)
  violations=$(printf '%s\n' "$includes" | while IFS= read -r hit; do
    target=$(printf '%s' "$hit" | sed 's/.*#include "\([^"/]*\)[/"].*/\1/')
    case "$allowed" in *" $target "*) ;; *) [ -z "$hit" ] || echo "$hit: $name may not include $target" ;; esac
  done)
  if [ -n "$violations" ]; then
    echo "$violations"
    bad=1
  fi
done

# Third parties stay in .cpp files (Eigen apart) and in the headers those files alone share: the folders
# io/hdf5, io/volume, io/dicom, io/vtk, and NAME_impl.hpp.
foreign=$(grep -rnE '^ *#include <(hdf5|xraylib|vtk|itk|gdcm|opencv|CGAL|CLI|nlohmann|nlopt|cholmod|gtest)' --include='*.hpp' \
  libbreast | grep -vE '^libbreast/(io/(hdf5|volume|dicom|vtk)/|[a-z]+/[a-z_]+_impl\.hpp)' || true)
if [ -n "$foreign" ]; then
  echo "third party in a header: $foreign"
  bad=1
fi
exit $bad
