// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/segments.hpp"

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

constexpr const char *tissue_tag = "libbreast.tissue", *side_tag = "libbreast.side",
                     *nipple_tag = "libbreast.nipple_lps_mm", *skin_tag = "libbreast.skin_mm",
                     *midline_tag = "libbreast.midline_lps_mm", *scan_tag = "libbreast.scan_sha256";

// Colours of 3D Slicer's table of generic anatomy, where it has the tissue.
struct Look {
  Tissue tissue;
  const char* name;
  std::array<int, 3> colour;
};
constexpr std::array<Look, 6> looks = {
    {{Tissue::fat, "Fat", {230, 220, 70}},
     {Tissue::fibroglandular, "Fibroglandular tissue", {221, 130, 101}},
     {Tissue::skin, "Skin", {177, 122, 101}},
     {Tissue::muscle, "Chest wall", {192, 104, 88}},
     {Tissue::tumour, "Tumour", {144, 238, 144}},
     {Tissue::other, "Other body", {128, 174, 128}}}};

// Further names, in small letters with single blanks, by which people call their segments.
const std::map<std::string, Tissue>& known_names() {
  static const std::map<std::string, Tissue> names = {
      {"fat", Tissue::fat},
      {"adipose", Tissue::fat},
      {"adipose tissue", Tissue::fat},
      {"fibroglandular", Tissue::fibroglandular},
      {"fibroglandular tissue", Tissue::fibroglandular},
      {"gland", Tissue::fibroglandular},
      {"glandular tissue", Tissue::fibroglandular},
      {"skin", Tissue::skin},
      {"chest wall", Tissue::muscle},
      {"wall", Tissue::muscle},
      {"muscle", Tissue::muscle},
      {"pectoral muscle", Tissue::muscle},
      {"tumour", Tissue::tumour},
      {"tumor", Tissue::tumour},
      {"lesion", Tissue::tumour},
      {"other body", Tissue::other},
      {"other", Tissue::other},
      {"body", Tissue::other},
      {"background", Tissue::air},
      {"air", Tissue::air},
  };
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return list.empty() ? "none" : list;
}

std::vector<std::string> names_of(const std::vector<Segment>& segments) {
  std::vector<std::string> names;
  for (const Segment& segment : segments) names.push_back(segment.name);
  return names;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// What is known of a segment's name, or of it without the number that 3D Slicer may have added.
std::optional<Tissue> named_tissue(const std::string& name,
                                   const std::map<std::string, Tissue>& known) {
  for (const bool number : {true, false}) {
    const auto found = known.find(plain_name(name, number));
    if (found != known.end()) return found->second;
  }
  return std::nullopt;
}

const std::string* tag_of(const std::vector<Segment>& segments, const char* key) {
  for (const Segment& segment : segments) {
    const auto found = segment.tags.find(key);
    if (found != segment.tags.end()) return &found->second;
  }
  return nullptr;
}

std::optional<Tissue> tissue_of(const Segment& segment, const TissueCodes& codes) {
  if (const auto named = codes.names.find(segment.name); named != codes.names.end())
    return named->second;
  if (const auto coded = codes.values.find(segment.value); coded != codes.values.end())
    return coded->second;
  if (const auto tag = segment.tags.find(tissue_tag); tag != segment.tags.end())
    return tissue_from_text(tag->second);
  if (const auto preset = named_tissue(segment.name, codes.preset.names)) return preset;
  return named_tissue(segment.name, known_names());
}

void check_asked(const std::vector<Segment>& segments, const TissueCodes& codes,
                 const std::string& name) {
  const std::string there = listed(names_of(segments));
  for (const auto& [asked, tissue] : codes.names) {
    const bool found =
        std::any_of(segments.begin(), segments.end(),
                    [&, &asked = asked](const Segment& s) { return s.name == asked; });
    if (!found) {
      throw input_error(name, ": has no segment '", asked,
                        "', which --code names; its segments are ", there);
    }
  }
  for (const auto& [value, tissue] : codes.values) {
    const bool found =
        std::any_of(segments.begin(), segments.end(),
                    [&, &value = value](const Segment& s) { return s.value == value; });
    if (!found && value != 0) {
      throw input_error(name, ": no segment has the value ", value,
                        ", which --code names; its segments are ", there);
    }
  }
}

/// A preset of another program would make everything `other`.
void check_preset(const Volume<float>& volume, const CodePreset& preset, const std::string& name) {
  if (preset.values.empty() && preset.names.empty()) return;
  for (const float value : volume.voxels) {
    if (value != 0 && preset.values.count(int(value)) != 0) return;
  }
  throw input_error(name, ": has none of the values of the preset that --code names");
}

std::uint8_t translate(float value, const std::map<int, Tissue>& codes, const std::string& name) {
  if (codes.empty()) {
    if (value >= 0 && value < n_tissues && value == float(int(value))) return std::uint8_t(value);
    throw input_error(name, ": holds ", value, ", which is not a tissue code from 0 to ",
                      n_tissues - 1, "; translate it with --code");
  }
  const bool whole = value >= 0 && value <= 65535 && value == float(int(value));
  const auto found = whole ? codes.find(int(value)) : codes.end();
  if (found != codes.end()) return std::uint8_t(found->second);
  return std::uint8_t(value == 0 ? Tissue::air : Tissue::other);
}

}  // namespace

TissueCodes parse_tissue_codes(const std::vector<std::string>& texts) {
  TissueCodes codes;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos) {
      const CodePreset preset = load_code_preset(text);
      codes.preset.values.insert(preset.values.begin(), preset.values.end());
      codes.preset.names.insert(preset.names.begin(), preset.names.end());
      continue;
    }
    const std::string first = text.substr(0, equals), second = text.substr(equals + 1);
    const bool turned = is_number(second);  // wall=3
    const std::string &foreign = turned ? second : first, &ours = turned ? first : second;
    if (foreign.empty() || ours.empty()) {
      throw input_error("--code: '", text,
                        "' is not NUMBER=TISSUE, TISSUE=NUMBER or NAME=TISSUE; for example "
                        "29=fibroglandular or wall=3");
    }
    const auto tissue = tissue_from_text(ours);
    if (!tissue) {
      throw input_error(
          "--code: '", text, "': '", ours,
          "' is not a tissue; the tissues are air, fat, fibroglandular, skin, muscle (or wall), "
          "tumour, other");
    }
    if (!is_number(foreign)) {
      codes.names[foreign] = *tissue;
      continue;
    }
    const double code = parse_number(foreign, "--code");
    if (!(code >= 0 && code <= 65535)) throw input_error("--code: ", code, " must be 0 to 65535");
    codes.values[int(code)] = *tissue;
  }
  return codes;
}

Segment segment_of(Tissue tissue) {
  for (const Look& look : looks) {
    if (look.tissue != tissue) continue;
    Segment segment{look.name, int(tissue), {}, {}};
    for (std::size_t c = 0; c < 3; ++c) segment.colour[c] = look.colour[c] / 255.0;
    segment.tags[tissue_tag] = tissue_name(tissue);
    return segment;
  }
  return {"Air", 0, {0, 0, 0}, {}};
}

std::vector<Segment> segments_of(const LabelVolume& labels) {
  std::vector<Segment> segments;
  for (const Look& look : looks) {
    if (std::find(labels.tissue.begin(), labels.tissue.end(), std::uint8_t(look.tissue)) ==
        labels.tissue.end())
      continue;
    Segment segment = segment_of(look.tissue);
    segment.tags[side_tag] = side_name(labels.side);
    if (const auto nipple = labels.landmarks.find("nipple"); nipple != labels.landmarks.end()) {
      const Vec3& at = nipple->second;
      segment.tags[nipple_tag] =
          format_number(at[0]) + " " + format_number(at[1]) + " " + format_number(at[2]);
    }
    if (labels.skin_thickness > 0) segment.tags[skin_tag] = format_number(labels.skin_thickness);
    if (labels.midline_mm) segment.tags[midline_tag] = format_number(*labels.midline_mm);
    if (!labels.scan_sha256.empty()) segment.tags[scan_tag] = labels.scan_sha256;
    segments.push_back(segment);
  }
  return segments;
}

TissueCodes codes_of(const std::vector<Segment>& segments, const TissueCodes& codes,
                     const std::string& name) {
  if (segments.empty()) throw input_error(name, ": has no segment");
  check_asked(segments, codes, name);
  TissueCodes all;
  all.values[0] = Tissue::air;
  for (const Segment& segment : segments) {
    const auto tissue = tissue_of(segment, codes);
    if (!tissue) {
      std::vector<std::string> known;
      for (const Look& look : looks) known.emplace_back(look.name);
      throw input_error(name, ": segment '", segment.name, "' (value ", segment.value,
                        ") has an unknown name: rename it to one of ", listed(known),
                        ", or state its tissue with --code ", segment.value, "=TISSUE");
    }
    all.values[segment.value] = *tissue;
  }
  return all;
}

LabelVolume translate_labels(const Volume<float>& volume, const TissueCodes& codes,
                             const std::string& name) {
  if (!codes.names.empty()) {
    throw input_error(name, ": is not a segmentation (.seg.nrrd) and has no segment '",
                      codes.names.begin()->first, "', which --code names: give its number instead");
  }
  std::map<int, Tissue> values = codes.values;
  values.insert(codes.preset.values.begin(), codes.preset.values.end());
  check_preset(volume, codes.preset, name);
  LabelVolume labels;
  labels.grid = volume.grid;
  labels.tissue.reserve(volume.voxels.size());
  for (const float value : volume.voxels) labels.tissue.push_back(translate(value, values, name));
  return labels;
}

std::optional<Side> tagged_side(const std::vector<Segment>& segments) {
  const std::string* tagged = tag_of(segments, side_tag);
  return tagged == nullptr ? std::nullopt : std::optional(side_from_name(*tagged));
}

std::string tagged_scan(const std::vector<Segment>& segments) {
  const std::string* tagged = tag_of(segments, scan_tag);
  return tagged == nullptr ? "" : *tagged;
}

LabelVolume labels_of(const SegmentedVolume& segmentation, const TissueCodes& codes,
                      const std::optional<Side>& side, const std::string& name) {
  const auto& segments = segmentation.segments;
  LabelVolume labels = translate_labels(segmentation.values, codes_of(segments, codes, name), name);
  const std::optional<Side> stated = side ? side : tagged_side(segments);
  if (!stated) {
    throw input_error(name, ": does not state which breast it shows: give --side left or right");
  }
  labels.side = *stated;
  labels.fibroglandular_fraction.reserve(labels.tissue.size());
  for (const std::uint8_t tissue : labels.tissue) {
    labels.fibroglandular_fraction.push_back(Tissue(tissue) == Tissue::fibroglandular ? 1.0F
                                                                                      : 0.0F);
  }
  if (const std::string* nipple = tag_of(segments, nipple_tag)) {
    const std::size_t one = nipple->find(' '), two = nipple->find(' ', one + 1);
    const std::string where = name + ": tag " + nipple_tag;
    if (two == std::string::npos) throw input_error(where, " '", *nipple, "' is not three numbers");
    labels.landmarks["nipple"] = Vec3(parse_number(nipple->substr(0, one), where),
                                      parse_number(nipple->substr(one + 1, two - one - 1), where),
                                      parse_number(nipple->substr(two + 1), where));
  }
  if (const std::string* skin = tag_of(segments, skin_tag))
    labels.skin_thickness = parse_number(*skin, name + ": tag " + skin_tag);
  if (const std::string* midline = tag_of(segments, midline_tag))
    labels.midline_mm = parse_number(*midline, name + ": tag " + midline_tag);
  labels.scan_sha256 = tagged_scan(segments);
  labels.content_sha256 = segmentation.content_sha256;
  return labels;
}

LabelVolume completed_labels(const LabelVolume& edited, const LabelVolume& native,
                             const std::string& name) {
  LabelVolume labels = native;
  labels.content_sha256 = edited.content_sha256;
  const Grid& grid = native.grid;
  bool overlap = false;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 at = edited.grid.to_index(grid.to_patient(Vec3(i, j, k))).array().round();
        const bool inside = edited.grid.contains(int(at[0]), int(at[1]), int(at[2]));
        const Tissue tissue = inside ? edited.at(int(at[0]), int(at[1]), int(at[2])) : Tissue::air;
        const std::size_t voxel = grid.offset(i, j, k);
        overlap = overlap || inside;
        if (std::uint8_t(tissue) == native.tissue[voxel]) continue;
        labels.tissue[voxel] = std::uint8_t(tissue);
        labels.fibroglandular_fraction[voxel] = tissue == Tissue::fibroglandular ? 1.0F : 0.0F;
      }
    }
  }
  if (!overlap)
    throw input_error(name,
                      ": covers a different region than the labels from which it is said to come");
  return labels;
}

}  // namespace breast
