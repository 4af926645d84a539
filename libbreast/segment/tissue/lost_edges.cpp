// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/lost_edges.hpp"

#include "core/elementary.hpp"
#include "segment/tissue/coil_trend.hpp"

namespace breast {

double lost_edges_percent(const Volume<float>& scan, const Mask& interior,
                          const Fibroglandular& gland) {
  constexpr double least_edges = 0.01;  // of all links; the surface of 5 % of the breast has more
  Blocks blocks = blocks_of(scan, interior);
  if (blocks.count == 0) return 0;
  remove_coil_trend(blocks);
  const std::vector<BlockLink> links = links_with_edges(blocks);
  const Volume<float> share = in_blocks(gland.fraction);
  const auto log_mixture = [&](std::size_t block) {
    return elementary::log(1 - share.voxels[block] * (1 - gland.gland_ratio));
  };
  double edges = 0, lost = 0;
  for (const BlockLink& link : links) {
    if (!link.edge) continue;
    const double shown = log_mixture(link.to) - log_mixture(link.from);
    edges += 1;
    lost += !(shown / link.change > 0.5);
  }
  return edges > least_edges * double(links.size()) ? 100 * lost / edges : 0;
}

}  // namespace breast
