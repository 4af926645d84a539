#include "io/lookup_file.hpp"

#include "io/hdf5/fields.hpp"

namespace breast {

void write_lookup(const std::filesystem::path& file, const MatchLookup& lookup) {
  Document document;
  put_header(document, {"lookup/1", lookup.side, lookup.history});
  document.attributes["/breast/lookup@from_view"] = array_of(view_name(lookup.from_view));
  document.attributes["/breast/lookup@to_view"] = array_of(view_name(lookup.to_view));
  document.attributes["/breast/lookup@pitch_mm"] = array_of(lookup.pitch);
  const auto nv = std::size_t(lookup.nv), nu = std::size_t(lookup.nu),
             samples = std::size_t(lookup.samples);
  const auto put = [&](const std::string& name, auto values, std::vector<std::size_t> more) {
    std::vector<std::size_t> shape{nv, nu};
    shape.insert(shape.end(), more.begin(), more.end());
    document.datasets["/breast/lookup/" + name] = reshaped(array_of(std::move(values)), shape);
  };
  put("status", lookup.status, {});
  put("depth_mm", lookup.depth, {});
  put("curve_mm", lookup.curve, {samples, 2});
  put("deviation_mm", lookup.deviation, {samples});
  put("across", lookup.across, {samples, 2});
  put("imaged_mm", lookup.imaged, {samples, 3});
  document.datasets["/breast/lookup/band_without"] = array_of(lookup.band_without);
  save_document(file, document);
}

}  // namespace breast
