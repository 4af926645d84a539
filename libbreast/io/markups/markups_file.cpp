// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/markups_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lower_case.hpp"
#include "io/markups/fiducials_file.hpp"

namespace breast {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;
using ReadJson = nlohmann::json;  // an ordered one searches an object's keys one by one

namespace {

constexpr const char* schema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
    "Schema/markups-schema-v1.0.3.json#";

// A value of a few bytes takes tens of them in memory: one file of 16 MB of brackets would take more than a gigabyte.
ReadJson parsed(const std::string& text, const std::string& name) {
  constexpr int deepest = 64;
  const auto shallow = [&](int depth, ReadJson::parse_event_t, ReadJson&) {
    if (depth > deepest) throw input_error(name, ": nested more than ", deepest, " deep");
    return true;
  };
  return ReadJson::parse(text, shallow, false);
}

std::string text_of(const ReadJson& object, const char* key, const std::string& otherwise) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

Vec3 place_of(const ReadJson& point, bool ras, const std::string& where) {
  constexpr double farthest_mm = 1e6;
  const auto position = point.find("position");
  if (position == point.end() || !position->is_array() || position->size() != 3) {
    throw input_error(where, ": has no position of three numbers");
  }
  Vec3 at;
  for (std::size_t d = 0; d < 3; ++d) {
    const ReadJson& number = (*position)[d];
    at[int(d)] = number.is_number() ? number.get<double>() : std::nan("");
    if (!(std::abs(at[int(d)]) <= farthest_mm)) {
      throw input_error(where, ": position is not three numbers of mm");
    }
  }
  return ras ? Vec3(-at[0], -at[1], at[2]) : at;
}

void add_points(const ReadJson& markups, const std::string& where,
                std::vector<MarkupPoint>& points) {
  const std::string space = text_of(markups, "coordinateSystem", "LPS");
  if (space != "LPS" && space != "RAS") {
    throw input_error(where, ": coordinateSystem '", space, "': LPS or RAS are read");
  }
  const std::string units = text_of(markups, "coordinateUnits", "mm");
  if (units != "mm") throw input_error(where, ": coordinateUnits '", units, "': must be mm");
  const auto list = markups.find("controlPoints");
  if (list == markups.end() || !list->is_array()) return;
  for (std::size_t n = 0; n < list->size(); ++n) {
    const ReadJson& point = (*list)[n];
    const std::string here = where + ", point " + std::to_string(n);
    if (!point.is_object()) throw input_error(here, ": is not an object");
    if (text_of(point, "positionStatus", "defined") != "defined") continue;  // not placed yet
    points.push_back({text_of(point, "label", ""), place_of(point, space == "RAS", here)});
  }
}

Json point_json(const MarkupPoint& point, std::size_t number) {
  return {{"id", std::to_string(number + 1)},
          {"label", point.label},
          {"description", ""},
          {"associatedNodeID", ""},
          {"position", {point.at[0], point.at[1], point.at[2]}},
          {"orientation", {-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0}},
          {"selected", true},
          {"locked", true},
          {"visibility", true},
          {"positionStatus", "defined"}};
}

bool is_fiducials_name(const fs::path& file) {
  return lower_case(file.extension().string()) == ".fcsv";
}

std::vector<MarkupPoint> read_markups_json(const fs::path& file) {
  constexpr std::uintmax_t most_bytes = 16 << 20;
  const ReadJson root = parsed(read_text(file, most_bytes), file.string());
  const auto lists = root.is_object() ? root.find("markups") : root.end();
  if (root.is_discarded() || !root.is_object() || lists == root.end() || !lists->is_array()) {
    throw input_error(file.string(),
                      ": is not a markups file of 3D Slicer (JSON with a list 'markups')");
  }
  std::vector<MarkupPoint> points;
  for (const ReadJson& markups : *lists) {
    if (!markups.is_object()) throw input_error(file.string(), ": 'markups' contains no object");
    add_points(markups, file.string(), points);
  }
  return points;
}

}  // namespace

bool is_markups_name(const fs::path& file) {
  return lower_case(file.filename().string()).ends_with(".mrk.json") || is_fiducials_name(file);
}

std::vector<MarkupPoint> read_markups(const fs::path& file) {
  std::vector<MarkupPoint> points =
      is_fiducials_name(file) ? read_fiducials(file) : read_markups_json(file);
  if (points.empty()) throw input_error(file.string(), ": no points with a position");
  return points;
}

void write_markups(const fs::path& file, const Markups& markups) {
  Json points = Json::array();
  for (std::size_t n = 0; n < markups.points.size(); ++n)
    points.push_back(point_json(markups.points[n], n));
  const Json display = {{"visibility", true},
                        {"opacity", 1.0},
                        {"color", markups.colour},
                        {"selectedColor", markups.colour},
                        {"propertiesLabelVisibility", markups.curve},
                        {"pointLabelsVisibility", !markups.curve},
                        {"textScale", 3.0},
                        {"glyphType", "Sphere3D"},
                        {"glyphScale", markups.curve ? 0.5 : 2.0},
                        {"useGlyphScale", true},
                        {"sliceProjection", true}};
  const Json entry = {{"type", markups.curve ? "Curve" : "Fiducial"},
                      {"name", markups.name},
                      {"coordinateSystem", "LPS"},
                      {"coordinateUnits", "mm"},
                      {"locked", true},
                      {"labelFormat", "%N-%d"},
                      {"controlPoints", points},
                      {"display", display}};
  // "tool" first, as in every JSON file of ours: by it a later run knows what it may replace.
  const Json root = {{"tool", "libbreast"}, {"@schema", schema}, {"markups", Json::array({entry})}};
  write_text(file, root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

MarkupPoint point_named(const std::vector<MarkupPoint>& points, const std::string& label,
                        const std::string& name) {
  std::string labels;
  for (const MarkupPoint& point : points) {
    if (lower_case(point.label) == lower_case(label)) return point;
    labels += (labels.empty() ? "'" : ", '") + point.label + "'";
  }
  if (points.size() == 1) return points.front();
  throw input_error(name, ": has ", points.size(), " points, none of which is labelled '", label,
                    "'; they are ", labels);
}

}  // namespace breast
