#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Labels, geometry and mesh of one scan are the same bytes on every x86-64 processor:
#   programs   segment, fit-hermite and hexmesh hold no instruction beyond SSE2 and call no function of the C library
#              or of a BLAS that is chosen by the processor
#   settings   with other kernels of the C library, OpenBLAS and OpenCV, and on two threads
#   emulated   on a processor without AVX and on one with AVX2 and fused multiply-add (qemu-user)
# same-bytes.sh PROGRAMS [SCAN [ELEMENTS]]  (without SCAN: the small one in testdata)
# EMULATED=0 leaves out qemu, which takes thirty times as long: for a scan of full size.
set -euo pipefail
programs=$(cd "$1" && pwd) scan=$(realpath "${2:-$(dirname "$0")/../../testdata/small-scan.nrrd}") elements=${3:-6}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
pass() { passed=$((passed + 1)); echo "ok: $*"; }
fail() { echo "FAILED: $*"; exit 1; }
names=(segment fit-hermite hexmesh) files=(labels geometry mesh)

check_programs() {
  local name found chosen='exp|exp2|expm1|log|log2|pow|sin|cos|sincos|tan|atan|atan2|asin|acos|fma'
  for name in "${names[@]}"; do
    # Registers and mnemonics of AVX, AVX-512 and FMA: all of them start with v.
    found=$(objdump -d --no-show-raw-insn "$programs/$name" | grep -m1 -P '\t(v[a-z0-9]+ .*%[xyz]mm|vzero)' || true)
    [ -z "$found" ] || fail "$name holds an instruction that not every processor has: $found"
    # hexmesh calls some for the tetrahedra it can write besides, on which its mesh does not depend.
    found=$(nm -D --undefined-only "$programs/$name" | grep -wE "($chosen)f?(@.*)?" | sed -n 1p || true)
    [ "$name" != hexmesh ] || found=
    [ -z "$found" ] || fail "$name calls a function that is chosen by the processor: $found"
    found=$(objdump -p "$programs/$name" | grep -m1 -E 'NEEDED.*(blas|lapack|cholmod)' || true)
    [ -z "$found" ] || fail "$name links a library whose kernels are chosen by the processor: $found"
  done
  pass "programs: ${names[*]} hold nothing that depends on the processor"
}

# The three stages in a folder of their own: stages FOLDER THREADS [WRAPPER...]. (With more threads than one a program
# starts itself anew, which qemu would do outside qemu.)
stages() {
  local at=$work/$1 threads=$2
  shift 2
  mkdir -p "$at"
  ln -s "$scan" "$at"
  (cd "$at"
   "$@" "$programs/segment" "${scan##*/}" labels.vtkhdf --side left --quiet --threads "$threads"
   "$@" "$programs/fit-hermite" labels.vtkhdf geometry.vtkhdf --quiet --threads "$threads"
   "$@" "$programs/hexmesh" geometry.vtkhdf labels.vtkhdf mesh.vtkhdf --elements "$elements" --quiet --threads "$threads"
  ) > "$work/log" 2>&1 || { tail -n 5 "$work/log"; fail "the stages run ($*)"; }
}
compare() { # FOLDER WHAT
  local file
  for file in "${files[@]}"; do
    cmp "$work/here/$file.vtkhdf" "$work/$1/$file.vtkhdf" || fail "$file is the same $2"
  done
  pass "the same bytes $2"
}

check_settings() {
  stages kernels 1 env GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX,-AVX2,-FMA,-FMA4,-AVX512F OPENBLAS_CORETYPE=Prescott \
    OPENCV_CPU_DISABLE=SSE4.1,SSE4.2,AVX,FP16,AVX2,AVX512-SKX
  compare kernels "with the kernels of the C library, OpenBLAS and OpenCV for old processors"
  stages threads 2
  compare threads "on two threads"
}

check_emulated() {
  stages old 1 qemu-x86_64 -cpu Penryn
  compare old "on an emulated processor with SSE4.1 and no more"
  stages new 1 qemu-x86_64 -cpu Haswell-noTSX
  compare new "on an emulated processor with AVX2 and fused multiply-add"
}

check_programs
stages here 1
check_settings
[ "${EMULATED:-1}" = 0 ] || check_emulated
(cd "$work/here" && sha256sum "${files[@]/%/.vtkhdf}")
echo "$passed passed, 0 failed"
