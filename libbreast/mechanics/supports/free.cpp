// SPDX-License-Identifier: GPL-3.0-or-later
// A cut on which nothing acts.
#include "core/table.hpp"
#include "mechanics/supports/supports.hpp"

namespace breast {

namespace {

class Free final : public BodySupport {
 public:
  Free() : BodySupport(SupportPlace::cut, "free") {}

  std::string clause() const override { return "its cut is free"; }
  SupportPtr with_springs(double stiffness) const override {
    return cut_support("spring:" + format_number(stiffness));
  }
};

}  // namespace

const SupportKind& supports::free() {
  static const SupportKind kind{{SupportPlace::cut},
                                "free",
                                "free",
                                "free",
                                false,
                                [](const SupportText& text) -> SupportPtr {
                                  text.expect(0, 0);
                                  return std::make_shared<Free>();
                                }};
  return kind;
}

}  // namespace breast
