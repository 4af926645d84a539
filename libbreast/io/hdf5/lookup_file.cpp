// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/lookup_file.hpp"

#include "io/hdf5/fields.hpp"

namespace breast {

namespace {

void put_lookup(const std::string& group, const MatchLookup& lookup, Document& document) {
  document.attributes[group + "@from_view"] = array_of(view_name(lookup.from_view));
  document.attributes[group + "@to_view"] = array_of(view_name(lookup.to_view));
  document.attributes[group + "@pitch_mm"] = array_of(lookup.pitch);
  const auto nv = std::size_t(lookup.nv), nu = std::size_t(lookup.nu),
             samples = std::size_t(lookup.samples);
  const auto put = [&](const std::string& name, auto values, std::vector<std::size_t> more) {
    std::vector<std::size_t> shape{nv, nu};
    shape.insert(shape.end(), more.begin(), more.end());
    document.datasets[group + "/" + name] = reshaped(array_of(std::move(values)), shape);
  };
  put("status", lookup.status, {});
  put("depth_mm", lookup.depth, {});
  put("length_mm", lookup.length, {});
  put("curve_mm", lookup.curve, {samples, 2});
  put("deviation_mm", lookup.deviation, {samples});
  put("imaged_mm", lookup.imaged, {samples, 3});
  document.datasets[group + "/band_without"] = array_of(lookup.band_without);
}

}  // namespace

void write_lookup(const std::filesystem::path& file, const MatchLookup& lookup,
                  const MatchLookup* back) {
  Document document;
  put_header(document, {"lookup/1", lookup.side, lookup.history});
  put_lookup("/breast/lookup", lookup, document);
  if (back != nullptr) put_lookup("/breast/lookup_back", *back, document);
  save_document(file, document);
}

}  // namespace breast
