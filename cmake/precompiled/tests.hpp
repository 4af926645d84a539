// What nearly every test reads.
#include "common.hpp"

#include <gtest/gtest.h>
