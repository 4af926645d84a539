// SPDX-License-Identifier: GPL-3.0-or-later
// fault_inputs FOLDER: small valid files of every format, for tests/fuzz/whole-tools.py.
#include <cstdio>

#include "faults/cases.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    std::filesystem::create_directories(argv[1]);
    breast::faults::write_inputs(argv[1]);
    breast::faults::write_more_inputs(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fault_inputs: %s\n", error.what());
    return 1;
  }
  return 0;
}
