// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the process limits (stack, memory) before the libraries start.
#pragma once

namespace breast {

/// Returns true; a program that calls it is linked with the check (preflight.cpp), which ends the
/// program with one line and exit code 1 if the limit on the stack or, where OpenBLAS is needed, on
/// memory is too small.
bool has_preflight();

}  // namespace breast
