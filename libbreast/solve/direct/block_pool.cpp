// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct/block_pool.hpp"

namespace breast {

BlockPool::Block BlockPool::take(std::size_t size) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = free_.lower_bound(size);
    // A block more than twice too large is left for a request that needs it.
    if (found != free_.end() && found->first <= 2 * size) {
      Block block{found->first, std::move(found->second)};
      free_.erase(found);
      return block;
    }
  }
  return {size, std::unique_ptr<double[]>(new double[size])};
}

void BlockPool::give_back(Block block) {
  if (block.data == nullptr) return;
  const std::lock_guard lock(mutex_);
  free_.emplace(block.size, std::move(block.data));
}

}  // namespace breast
