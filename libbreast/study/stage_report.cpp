// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/stage_report.hpp"

#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/one_line.hpp"
#include "core/text/utf8.hpp"
#include "study/cells.hpp"

namespace breast {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct StageReport::Impl {
  Json root;

  const Json* find(std::string_view path) const {
    const Json* entry = &root;
    while (true) {
      const std::size_t slash = path.find('/');
      const std::string key(path.substr(0, slash));
      if (!entry->is_object() || !entry->contains(key)) return nullptr;
      entry = &entry->at(key);
      if (slash == std::string_view::npos) return entry;
      path.remove_prefix(slash + 1);
    }
  }
};

namespace {

const Json* first_number(const Json& entry, const std::string& name) {
  if (!entry.is_object()) return nullptr;
  for (const auto& [key, value] : entry.items()) {
    if (key == name && value.is_number()) return &value;
    if (const Json* below = first_number(value, name)) return below;
  }
  return nullptr;
}

}  // namespace

bool has_something(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && fs::file_size(file, ignored) > 0;
}

StageReport::StageReport() : impl_(std::make_shared<const Impl>(Impl{Json::object()})) {}

StageReport StageReport::parse(const std::string& json, const std::string& name) {
  constexpr int deepest = 64;       // the parser is recursive
  constexpr int most_keys = 20000;  // the keys of an object are searched one by one
  int keys = 0;
  const auto within = [&](int depth, Json::parse_event_t event, Json&) {
    if (depth > deepest)
      throw input_error(name, ": not a JSON report: nested more than ", deepest, " deep");
    if (event == Json::parse_event_t::key && ++keys > most_keys)
      throw input_error(name, ": not a JSON report: more than ", most_keys, " keys");
    return true;
  };
  Impl impl{Json::parse(valid_utf8(json), within, false)};
  if (!impl.root.is_object())
    throw input_error(name, ": not a JSON report; remove it, or run its stage again");
  StageReport report;
  report.impl_ = std::make_shared<const Impl>(std::move(impl));
  return report;
}

StageReport StageReport::read(const fs::path& file) {
  constexpr std::uintmax_t most_bytes = 16 << 20;
  return has_something(file) ? parse(read_text(file, most_bytes), file.string()) : StageReport();
}

bool StageReport::empty() const {
  return impl_->root.empty();
}

std::optional<double> StageReport::number(std::string_view path) const {
  const Json* entry = impl_->find(path);
  if (entry == nullptr || !entry->is_number()) return {};
  return entry->get<double>();
}

std::string StageReport::text(std::string_view path) const {
  const Json* entry = impl_->find(path);
  if (entry == nullptr || entry->is_null() || entry->is_structured()) return "";
  return entry->is_string() ? entry->get<std::string>() : entry->dump();
}

std::vector<std::string> StageReport::texts(std::string_view path) const {
  std::vector<std::string> list;
  const Json* entry = impl_->find(path);
  if (entry == nullptr || !entry->is_array()) return list;
  for (const Json& item : *entry)
    if (item.is_string()) list.push_back(item.get<std::string>());
  return list;
}

std::optional<double> StageReport::first(std::string_view name) const {
  const Json* entry = first_number(impl_->root, std::string(name));
  if (entry == nullptr) return {};
  return entry->get<double>();
}

std::string StageReport::landmark(const std::string& name) const {
  for (const std::string& key : {name, "artificial_" + name})
    if (impl_->find("landmarks/" + key) != nullptr) return key;
  return "";
}

std::optional<Vec3> StageReport::place(const std::string& landmark, const std::string& what) const {
  const Json* entry = impl_->find("landmarks/" + this->landmark(landmark) + "/" + what);
  if (entry == nullptr || !entry->is_array() || entry->size() != 3) return {};
  Vec3 place;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(*entry)[d].is_number()) return {};
    place[int(d)] = (*entry)[d].get<double>();
  }
  return place;
}

fs::path variant_of(const fs::path& run, const std::string& study, const std::string& variant) {
  return run / "studies" / study / variant;
}

std::optional<std::string> failure_of(const fs::path& name) {
  if (fs::exists(name.string() + ".vtkhdf")) return {};
  const StageReport report = StageReport::read(name.string() + ".json");
  if (report.empty()) return {};
  const std::string sentence = report.text("explanation");
  const std::string reason = report.text("reason");
  return one_line(!sentence.empty() ? sentence : !reason.empty() ? reason : report.text("status"));
}

std::optional<std::string> posture_failure_of(const fs::path& variant) {
  for (const char* shape : {"reference", "supine"})
    if (auto failure = failure_of(variant / shape)) return failure;
  return {};
}

}  // namespace breast
