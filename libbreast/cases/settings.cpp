// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/settings.hpp"

#include <algorithm>
#include <sstream>

#include "cases/case_file.hpp"
#include "cases/goals.hpp"
#include "cases/make_text.hpp"
#include "cases/scan_identity.hpp"
#include "cases/settings_table.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "material/material_set.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// Breasts of these presets slide on their rib cage; the others are held at the chest wall, as in
// the paper.
const std::vector<std::string> sliding_presets{"average", "slim", "broad", "heavy"};

bool among(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// The name of a scan without its extension: pat.001.nrrd and pat.002.nrrd differ, and the name of a
// folder keeps its dots.
std::string scan_name(const std::string& scan) {
  const fs::path path(scan);
  const std::string name = path.has_filename() ? path.filename() : path.parent_path().filename();
  for (const std::string ending : {".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".vtkhdf"})
    if (name.ends_with(ending)) return name.substr(0, name.size() - ending.size());
  return name;
}

// Material sets for a sliding breast contain the support at its chest wall.
bool has_wall(const fs::path& set) {
  std::error_code none;
  if (!fs::is_regular_file(set, none)) return false;
  std::istringstream lines(read_text(set));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("wall")) return true;
  return false;
}

class Decisions {
 public:
  explicit Decisions(const SettingsRequest& request)
      : request_(request),
        settings_(read_settings(request.pipelines)),
        goals_(request.pipelines, request.goals) {}

  std::string text() {
    refuse_unknown();
    name_settings();
    take_given();
    // A script whose variable is empty must not get the results of the phantom.
    if (value("CASE_FILE").empty() && request_.command_line.contains("CASE_FILE"))
      throw input_error("CASE_FILE: is empty; name the case file, or leave CASE_FILE out");
    if (!value("CASE_FILE").empty()) take_case_file();
    take_defaults();
    for (const Setting& setting : settings_)
      if (!is_made_here(value(setting.name)))
        check_choice(setting, value(setting.name), request_.pipelines);
    decide_scan();
    decide_folder();
    decide_model();
    goals_.check({request_.installed, phantom_, has_tumour_, body_slides_, printed(),
                  value("CLUSTER") == "slurm"},
                 value("PRESET"));
    if (goals_.about_case()) refuse_another_scan();
    derive_sets();
    leave_out();
    return text_;
  }

 private:
  bool has(const std::string& name) const { return values_.count(name) != 0; }
  std::string value(const std::string& name) const {
    const auto found = values_.find(name);
    return found == values_.end() ? "" : found->second;
  }
  // A file that a rule may make before it is read, such as the tumour of a phantom.
  bool is_made_here(const std::string& text) const { return text.starts_with(value("RUNS") + "/"); }
  bool printed() const { return !value("PAPER").empty(); }

  void line(const std::string& text) { text_ += text + make_line_end; }
  void set(const std::string& name, const std::string& value) {
    values_[name] = value;
    text_ += make_assignment(name, value);
  }
  void set_default(const std::string& name, const std::string& value) {
    if (!has(name)) set(name, value);
  }
  // Text that make expands where it is used, because MATERIALS and ELEMENTS may still change.
  void set_default_text(const std::string& name, const std::string& text) {
    if (has(name)) return;
    values_[name] = text;
    line(name + " = " + text);
  }

  void refuse_unknown() const;
  void name_settings();
  void take_given();
  void take_case_file();
  void take_defaults();
  void decide_scan();
  void decide_folder();
  void decide_model();
  void refuse_another_scan() const;
  void derive_sets();
  void leave_out();

  const SettingsRequest& request_;
  std::vector<Setting> settings_;
  Goals goals_;
  SettingsRequest::Values values_;
  bool phantom_ = false, body_slides_ = false, has_tumour_ = false;
  std::string text_;
};

void Decisions::refuse_unknown() const {
  std::vector<std::string> known{"share"};
  for (const Setting& setting : settings_) known.push_back(setting.name);
  for (const auto& [name, value] : request_.command_line)
    if (!among(name, known))
      throw input_error(name, " is not a setting", suggestion(name, known),
                        " (`make -f Makefile.pipeline help` lists all settings)");
}

void Decisions::name_settings() {
  std::string all = "share", of_case;
  for (const Setting& setting : settings_) {
    all += " " + setting.name;
    if (setting.of_case) of_case += (of_case.empty() ? "" : " ") + setting.name;
  }
  text_ += make_assignment("known_settings", all) + make_assignment("case_settings", of_case);
}

void Decisions::take_given() {
  const auto take = [&](const Setting& setting, const SettingsRequest::Values& from) {
    const auto found = from.find(setting.name);
    if (found == from.end()) return;
    check_characters(setting, found->second);
    values_[setting.name] = found->second;
  };
  for (const Setting& setting : settings_) {
    // Other programs read CHROMIUM from the environment, where it may be any command.
    if (setting.name != "CHROMIUM") take(setting, request_.environment);
    take(setting, request_.command_line);
  }
  take({"share", "words", false, "", {}, ""}, request_.command_line);
}

void Decisions::take_case_file() {
  std::vector<std::string> keys;
  for (const Setting& setting : settings_)
    if (setting.of_case) keys.push_back(setting.name);
  const CaseFile file = read_case_file(value("CASE_FILE"), keys);
  for (const Setting& setting : settings_)
    for (const auto& [key, given] : file.settings) {
      if (key != setting.name) continue;
      check_characters(setting, given);
      if (request_.command_line.count(key) == 0) set(key, given);
    }
}

void Decisions::take_defaults() {
  for (const Setting& setting : settings_) {
    const std::string& fallback = setting.default_value;
    if (fallback.empty()) continue;
    set_default(setting.name,
                setting.kind == "program" ? request_.programs + "/" + fallback : fallback);
  }
  set_default("PRESET", printed() || goals_.of_paper() ? "paper" : "average");
  if (value("RUNS").empty())
    throw input_error("RUNS: is empty; name the folder of all runs, or leave RUNS out");
}

void Decisions::decide_scan() {
  const std::string preset = value("PRESET"), at = value("RUNS") + "/phantom/" + preset;
  phantom_ = value("MR").empty();
  // A script whose variable is empty must not get the result of a phantom.
  if (phantom_ && has("MR") &&
      (request_.command_line.contains("MR") || !request_.environment.contains("MR")))
    throw input_error("MR: is empty; name the scan, or leave MR out for the phantom PRESET");
  body_slides_ = among(preset, sliding_presets);
  set("body_slides", body_slides_ ? "yes" : "");
  set("PHANTOM_MR", at + ".nrrd");
  set("PHANTOM_TRUTH", at + "-truth");
  set_default("CASE", phantom_ ? preset + (value("SIDE") == "right" ? "-right" : "")
                               : scan_name(value("MR")) + "-" + value("SIDE"));
  set("TRUTH", phantom_ ? at + "-truth/landmarks.tsv" : "");
  set("scan", phantom_ ? "phantom:" + preset : value("MR"));
  // The paper places its tumour freely, at the margin of the gland; that of the phantom has a known
  // displacement. No tumour is added to a patient's scan unless the user asks for one.
  set_default("TUMOUR", phantom_ ? at + "-truth/tumour-" + value("SIDE") + ".tsv" : "none");
  if (phantom_) set("MR", at + ".nrrd");
}

void Decisions::decide_folder() {
  const std::string name = value("CASE"), runs = value("RUNS");
  if (name.empty())
    throw input_error("CASE: is empty; name the folder of the run, or leave CASE out");
  if (name.starts_with('.') || name.find('/') != std::string::npos)
    throw input_error("CASE: '", name, "' is not a plain name of a folder below ", runs);
  if (request_.command_line.count("RUN") == 0)
    set("RUN", runs + "/" + name + (printed() ? "-as-printed" : ""));
}

// A living breast slides on the chest wall and is soft; the breast of the paper is held there and
// has the materials of Table II.
void Decisions::decide_model() {
  set_default("MATERIALS",
              !printed() && (!phantom_ || body_slides_) ? default_material_set : "seed2008");
  set_default("POPULATION_MATERIALS", default_material_set);
  const fs::path set_file = material_set_file(value("MATERIALS"), request_.pipelines);
  const bool slides = !printed() && has_wall(set_file);
  set("slides", slides ? "yes" : "");
  // The mean pressure of the paddle, kPa, at which a compression ends before REDUCTION, as in
  // clinical practice. Table II is too stiff for it.
  set_default("PRESSURE", slides ? "10" : "");
  // As printed, elements on the edge of the cuboid fold early (docs/validation/contact.md).
  set_default("AT_LEAST", printed() ? "30" : "40");
  if (printed()) {
    // Everything as printed: no gravity in compression and augmented Lagrangian, too.
    set_default_text("HEXMESH_OPTIONS", "$(PRINTED_HEXMESH)");
    set_default_text("MECHANICS", "$(PRINTED_MECHANICS)");
    set_default("COMPRESS_OPTIONS", "--gravity off --contact al");
  } else {
    // A breast that slides does so with the muscle behind it; one that is held needs none.
    set_default("MUSCLE", slides ? "measured" : "0");
    // The tissue around the breast moves with it.
    set_default("SURROUNDINGS", slides ? "16" : "0");
    set_default_text("HEXMESH_OPTIONS",
                     "--elements $(ELEMENTS) $(addprefix --muscle ,$(filter-out 0,$(MUSCLE))) "
                     "$(addprefix --surroundings ,$(filter-out 0,$(SURROUNDINGS)))");
    // An empty ELEMENT is the default of the programs. ACCURACY=MM chooses ELEMENTS and ELEMENT.
    set_default_text("MECHANICS", "--materials $(MATERIALS) $(addprefix --element ,$(ELEMENT))");
  }
  const std::string hexmesh = value("HEXMESH_OPTIONS");
  has_tumour_ = hexmesh.find("--tumour") == std::string::npos
                    ? value("TUMOUR") != "none"
                    : hexmesh.find("--tumour none") == std::string::npos;
  set("no_tumour", has_tumour_ ? "" : "yes");
}

// A run belongs to one scan and one side: another scan or side is refused before it overwrites
// anything.
void Decisions::refuse_another_scan() const {
  const std::string reason = mixed_up(value("RUN"), value("SIDE"), value("scan"));
  if (!reason.empty()) throw input_error(reason);
}

// With landmarks in a second posture, or a supine scan of the same patient, the set MATERIALS is
// the prior, and the chain runs with the set that `identify` finds.
void Decisions::derive_sets() {
  if (value("LANDMARKS").empty() && value("SUPINE").empty()) return;
  if (value("SUPINE") == "phantom" && !phantom_)
    throw input_error("SUPINE: phantom is the supine scan of a phantom, but MR=", value("MR"),
                      " is the scan of a patient; name the supine scan of this patient");
  set("prior_set", value("MATERIALS"));
  values_["MATERIALS"] = value("RUN") + "/identified.tsv";
  line("override MATERIALS := " + value("MATERIALS"));
}

// Parts of the model that the user leaves out; studies/leaveout.tsv measures the effect of each.
void Decisions::leave_out() {
  const std::string given = " " + value("LEAVE_OUT") + " ";
  const auto without = [&](const std::string& part, const std::string& text) {
    if (given.find(" " + part + " ") != std::string::npos) line("override " + text);
  };
  without("no-skin", "HEXMESH_OPTIONS += --skin 0");
  without("no-backward", "PRONE := --gravity 0,0,0");
  without("no-gravity-in-compression", "COMPRESS_OPTIONS += --gravity off");
  const bool derived = value("MATERIALS").starts_with(value("RUN") + "/");
  without("no-gland",
          "whole_set := " +
              (derived ? value("MATERIALS")
                       : material_set_file(value("MATERIALS"), request_.pipelines).string()));
  without("no-gland", "MATERIALS := " + value("RUN") + "/fat-only.tsv");
}

}  // namespace

std::string settings_for_make(const SettingsRequest& request) {
  return Decisions(request).text();
}

}  // namespace breast
