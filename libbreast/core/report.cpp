// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/report.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace breast {

using Json = nlohmann::ordered_json;

struct Report::Impl {
  Json root = Json::object();

  // Every part of a path is a key as it stands: names of landmarks may hold a '~', which JSON
  // pointers take for more.
  static std::vector<std::string> keys(std::string_view path) {
    std::vector<std::string> list;
    while (true) {
      const std::size_t slash = path.find('/');
      list.emplace_back(path.substr(0, slash));
      if (slash == std::string_view::npos) return list;
      path.remove_prefix(slash + 1);
    }
  }
  Json& at(std::string_view path) {
    Json* entry = &root;
    for (const std::string& key : keys(path)) {
      if (!entry->is_object()) *entry = Json::object();
      entry = &(*entry)[key];
    }
    return *entry;
  }
  const Json* find(std::string_view path) const {
    const Json* entry = &root;
    for (const std::string& key : keys(path)) {
      if (!entry->is_object()) return nullptr;
      const auto found = entry->find(key);
      if (found == entry->end()) return nullptr;
      entry = &*found;
    }
    return entry;
  }
  static Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }
};

Report::Report() : impl_(std::make_unique<Impl>()) {}
Report::~Report() = default;
Report::Report(const Report& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Report::Report(Report&&) noexcept = default;
Report& Report::operator=(Report other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}

void Report::set(std::string_view path, double value) {
  impl_->at(path) = Impl::number_or_null(value);
}
void Report::set(std::string_view path, long long value) {
  impl_->at(path) = value;
}
void Report::set(std::string_view path, bool value) {
  impl_->at(path) = value;
}
void Report::set(std::string_view path, std::string_view value) {
  impl_->at(path) = std::string(value);
}
void Report::set(std::string_view path, const std::vector<double>& value) {
  Json list = Json::array();
  for (const double x : value) list.push_back(Impl::number_or_null(x));
  impl_->at(path) = std::move(list);
}
void Report::set(std::string_view path, const std::vector<std::string>& value) {
  impl_->at(path) = value;
}
void Report::set(std::string_view path, const Vec3& value) {
  set(path, std::vector<double>{value.x(), value.y(), value.z()});
}
void Report::append(std::string_view path, std::string_view value) {
  Json& list = impl_->at(path);
  if (!list.is_array()) list = Json::array();
  list.push_back(std::string(value));
}
void Report::copy(std::string_view path, const Report& from) {
  const Json* entry = from.impl_->find(path);
  if (entry == nullptr) throw failed_error("report has no entry '", path, "'");
  impl_->at(path) = *entry;
}

bool Report::contains(std::string_view path) const {
  return impl_->find(path) != nullptr;
}
double Report::number(std::string_view path) const {
  if (!contains(path)) throw failed_error("report has no entry '", path, "'");
  const Json& entry = *impl_->find(path);
  if (!entry.is_number()) throw failed_error("report entry '", path, "' is not a number");
  return entry.get<double>();
}
std::string Report::text(std::string_view path) const {
  if (!contains(path)) throw failed_error("report has no entry '", path, "'");
  const Json& entry = *impl_->find(path);
  return entry.is_string() ? entry.get<std::string>()
                           : entry.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Report::json() const {
  // Texts of other programs (DICOM in Latin-1) may be no UTF-8: their odd bytes become U+FFFD.
  const auto dumped = [](const Json& root) {
    return root.dump(2, ' ', false, Json::error_handler_t::replace);
  };
  const std::string text = dumped(impl_->root);
  if (dumped(Json::parse(text, nullptr, false)) != text)
    throw failed_error("the report does not read back as written");
  return text + "\n";
}

Report Report::parse(const std::string& json, std::string_view name) {
  Report report;
  // Writing a value calls itself for every level: a file of brackets would use up the stack.
  constexpr int deepest = 64;
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest)
      throw input_error(name, ": not a JSON report: nested more than ", deepest, " deep");
    return true;
  };
  report.impl_->root = Json::parse(json, shallow, false);
  if (!report.impl_->root.is_object()) throw input_error(name, ": not a JSON report");
  return report;
}

void Timer::write(Report& report) const {
  for (const auto& [phase, seconds] : seconds_) {
    std::string key = phase;
    std::replace(key.begin(), key.end(), ' ', '_');
    report.set("seconds/" + key, seconds);
  }
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace breast
