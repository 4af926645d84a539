// The lookup as one HTML file: pointing at one view draws curve and band in the other, and the
// column in the body. No server, no network: images, curves and script are inside.
#pragma once

#include <string>

#include "matching/lookup.hpp"
#include "mesh/hex_mesh.hpp"
#include "projection/mammogram.hpp"

namespace breast {

/// `body` gives the outline of the imaged shape. Images are shown at most 0.25 mm a pixel. Throws
/// Error (input) when an image is not of its view.
std::string lookup_page(const MatchLookup& lookup, const Mammogram& from, const Mammogram& to,
                        const HexMesh& body);

}  // namespace breast
