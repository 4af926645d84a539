// SPDX-License-Identifier: GPL-3.0-or-later
// What nearly every test reads.
#include "common.hpp"

#include <gtest/gtest.h>
