// SPDX-License-Identifier: GPL-3.0-or-later
// The coil's sensitivity from how brightness changes, whatever the tissue.
#pragma once

#include "segment/tissue/blocks.hpp"

namespace breast {

/// Log sensitivity of the coil (mean 0 over all blocks, 0 outside) per block: the polynomial of the
/// fourth degree whose changes from block to block are those of most links. Within fat and within
/// gland brightness changes as the sensitivity does; only at the edges between them, which are few,
/// it does not. The sum of the absolute differences is made small, on which few large ones have
/// little influence (the sparseness of tissue gradients: Zheng, Grossman, Awate, Gee, MICCAI 2009).
/// Unlike an estimate from the brightness of fat (`fat_bias`) it cannot take a large gland for dim
/// fat.
std::vector<double> coil_trend(const Blocks& blocks);

/// Divides the brightness of the blocks by the sensitivity of the coil.
void remove_coil_trend(Blocks& blocks);

}  // namespace breast
