// SPDX-License-Identifier: GPL-3.0-or-later
// The targets of precompiled headers need a source file.
