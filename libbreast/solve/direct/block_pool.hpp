// SPDX-License-Identifier: GPL-3.0-or-later
// A pool of reusable memory blocks: fronts are allocated hundreds of times per factorisation, and
// fresh pages cost more than the arithmetic of a small front.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

namespace breast {

class BlockPool {
 public:
  struct Block {
    std::size_t size = 0;
    std::unique_ptr<double[]> data;
  };
  /// At least `size` values, not initialised. Any thread.
  Block take(std::size_t size);
  void give_back(Block block);

 private:
  std::mutex mutex_;
  std::multimap<std::size_t, std::unique_ptr<double[]>> free_;
};

}  // namespace breast
