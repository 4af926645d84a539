#include "core/report.hpp"

#include <sys/resource.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace breast {

using Json = nlohmann::ordered_json;

struct Report::Impl {
  Json root = Json::object();

  static Json::json_pointer pointer(std::string_view path) {
    return Json::json_pointer("/" + std::string(path));
  }
  Json& at(std::string_view path) { return root[pointer(path)]; }
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

bool Report::contains(std::string_view path) const {
  return impl_->root.contains(Impl::pointer(path));
}
double Report::number(std::string_view path) const {
  if (!contains(path)) throw failed_error("report has no entry '", path, "'");
  const Json& entry = impl_->root.at(Impl::pointer(path));
  if (!entry.is_number()) throw failed_error("report entry '", path, "' is not a number");
  return entry.get<double>();
}
std::string Report::text(std::string_view path) const {
  if (!contains(path)) throw failed_error("report has no entry '", path, "'");
  const Json& entry = impl_->root.at(Impl::pointer(path));
  return entry.is_string() ? entry.get<std::string>() : entry.dump();
}

std::string Report::json() const {
  return impl_->root.dump(2) + "\n";
}

Report Report::parse(const std::string& json, std::string_view name) {
  Report report;
  report.impl_->root = Json::parse(json, nullptr, false);
  if (!report.impl_->root.is_object()) throw input_error(name, ": not a JSON report");
  return report;
}

void Timer::write(Report& report) const {
  for (const auto& [phase, seconds] : seconds_) report.set("seconds/" + phase, seconds);
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
