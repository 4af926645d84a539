// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the process limits (stack, memory) before the libraries start.
#pragma once

namespace breast {

/// True; a program that asks has the check (preflight.cpp) in it: too small a stack or, where OpenBLAS is needed, too
/// small a memory limit ends it with one line and exit code 1.
bool has_preflight();

}  // namespace breast
