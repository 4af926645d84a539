// SPDX-License-Identifier: GPL-3.0-or-later
// A picture drawn without enough memory is noticed. That VTK and FreeType leave out what they have no memory for, without an
// error, is what the fault cases of render show.
#include "figures/drawing_memory.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace breast {
namespace {

// Larger than any machine has, and volatile so that the compiler does not leave the request out.
void ask_for_too_much() {
  const volatile std::size_t size = std::numeric_limits<std::ptrdiff_t>::max();
  ::operator delete(::operator new(size));
}

TEST(DrawingMemory, NoticesARefusalAlsoWhenNobodyReportsIt) {
  const DrawingMemory memory;
  EXPECT_FALSE(memory.refused());
  EXPECT_THROW(ask_for_too_much(), std::bad_alloc);
  EXPECT_TRUE(memory.refused());
}

TEST(DrawingMemory, StartsAnewAndWatchesNoLongerThanItExists) {
  std::optional<DrawingMemory> first(std::in_place);
  EXPECT_THROW(ask_for_too_much(), std::bad_alloc);
  first.reset();
  EXPECT_THROW(ask_for_too_much(), std::bad_alloc);
  const DrawingMemory second;
  EXPECT_FALSE(second.refused());
}

}  // namespace
}  // namespace breast
