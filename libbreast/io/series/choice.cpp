// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/choice.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/text/lists.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// What is found in a folder, with numbers from 1 for the stacks.
struct Contents {
  fs::path folder;
  DicomFolder found;  ///< without its images
  std::vector<DicomStack> stacks;
  int localisers = 0;  ///< images

  std::string numbered(std::size_t index) const {
    return message(index + 1, " = ", stacks[index].label());
  }
  /// With what tells series of the same label apart.
  std::string described(std::size_t index) const {
    const DicomImage& first = stacks[index].first();
    Vec3::Index axis = 0;
    first.row.cross(first.column).cwiseAbs().maxCoeff(&axis);
    return message(numbered(index), " (",
                   std::array{"sagittal", "coronal", "axial"}[std::size_t(axis)], ", ",
                   first.file.lexically_relative(folder).string(), ")");
  }
};

bool is_localiser(const DicomStack& stack) {
  return stack.first().localiser;
}

Contents contents_of(const fs::path& folder) {
  Contents contents;
  contents.folder = folder;
  contents.found = find_images(folder);
  contents.stacks = stacks_of(std::move(contents.found.images), folder.string());
  for (DicomStack& stack : contents.stacks) {
    contents.found.copies += stack.repeats;
    if (is_localiser(stack)) contents.localisers += int(stack.slices.size());
    // A file that is damaged before it names its series may belong to any.
    for (const auto& [series, text] : contents.found.damaged)
      if (series.empty() || series == stack.first().series_uid) stack.fault = text;
  }
  return contents;
}

/// What was found and is not among the series, in one line; nothing if there is nothing.
std::vector<std::string> passed_over(const Contents& contents) {
  std::vector<std::string> kinds;
  const auto add = [&](const std::string& kind, int count) {
    if (count > 0) kinds.push_back(message(kind, " (", count, ")"));
  };
  for (const auto& [kind, count] : contents.found.without_pixels) add(kind, count);
  add("localiser image", contents.localisers);
  add("copy of another image", contents.found.copies);
  add("link to a folder", contents.found.folders_not_followed);
  if (kinds.empty()) return {};
  return {contents.folder.string() + ": passed over: " + join(kinds, ", ")};
}

bool is_large(const DicomStack& stack) {
  constexpr double least_mm = 60;
  return stack.extent().minCoeff() >= least_mm;
}

/// The rule of series_rule, better first.
bool better(const DicomStack& a, const DicomStack& b) {
  constexpr double finer = 0.95;
  if (is_large(a) != is_large(b)) return is_large(a);
  if (a.first().contrast != b.first().contrast) return a.first().contrast < b.first().contrast;
  if (a.first().derived != b.first().derived) return b.first().derived;
  if (a.time != b.time) return a.time < b.time;
  const auto voxel = [](const DicomStack& stack) {
    return stack.first().pixel.prod() * stack.thickness();
  };
  return voxel(a) < finer * voxel(b);
}

bool shows(const DicomStack& stack, const std::optional<Side>& side) {
  return !side || !stack.side || *stack.side == *side;
}

bool is_candidate(const DicomStack& stack, const ScanChoice& choice) {
  return stack.fault.empty() && !is_localiser(stack) && shows(stack, choice.side);
}

/// Indices of the stacks that none is better than; empty if none is a volume.
std::vector<std::size_t> best_of(const Contents& contents, const ScanChoice& choice) {
  std::vector<std::size_t> best;
  const auto& stacks = contents.stacks;
  for (std::size_t n = 0; n < stacks.size(); ++n) {
    if (!is_candidate(stacks[n], choice)) continue;
    if (!best.empty() && better(stacks[best.front()], stacks[n])) continue;
    if (!best.empty() && better(stacks[n], stacks[best.front()])) best.clear();
    best.push_back(n);
  }
  return best;
}

std::string listed(const Contents& contents, const std::vector<std::size_t>& which) {
  constexpr std::size_t most = 8;
  std::vector<std::string> texts;
  for (const std::size_t n : which)
    if (texts.size() < most) texts.push_back(contents.described(n));
  return join(texts, "; ") + (which.size() > most ? "; ... (--list shows all)" : "");
}

std::vector<std::size_t> all_of(const Contents& contents) {
  std::vector<std::size_t> all;
  for (std::size_t n = 0; n < contents.stacks.size(); ++n) all.push_back(n);
  return all;
}

/// No series is a volume that shows the breast asked for.
Error none_of(const Contents& contents, const ScanChoice& choice) {
  const std::string where = contents.folder.string();
  const auto& stacks = contents.stacks;
  if (stacks.empty() && !contents.found.damaged.empty())
    return input_error(contents.found.damaged.front().text);
  if (stacks.empty()) {
    const std::vector<std::string> rest = passed_over(contents);
    const std::vector<fs::path>& others = contents.found.others;
    if (!rest.empty())
      return input_error(rest.front(),
                         "; no image of a scan is left: give the folder of its slices");
    return input_error(where, ": no DICOM images in this folder or below it",
                       others.empty()
                           ? ""
                           : message(", but ", others.size(), " other files such as ",
                                     others.front().lexically_relative(contents.folder).string(),
                                     ": unpack archives; name a .nrrd, .nii or .mha file itself"));
  }
  std::vector<std::string> faults;
  for (const DicomStack& stack : stacks)
    if (!stack.fault.empty() && !is_localiser(stack)) faults.push_back(stack.fault);
  if (faults.size() == 1) return input_error(faults.front());
  if (!faults.empty()) {
    return input_error(where, ": none of ", stacks.size(),
                       " series is a volume (--list shows why not); one of them: ", faults.front());
  }
  if (choice.side) {
    const bool other = std::any_of(stacks.begin(), stacks.end(), [&](const DicomStack& stack) {
      return !shows(stack, choice.side);
    });
    if (other)
      return input_error(where, ": no series shows the ", side_name(*choice.side),
                         " breast: ", listed(contents, all_of(contents)));
  }
  return input_error(where, ": holds nothing but localisers: ", listed(contents, all_of(contents)));
}

std::size_t asked_for(const Contents& contents, const ScanChoice& choice) {
  const auto& stacks = contents.stacks;
  if (choice.series > int(stacks.size())) {
    throw input_error(contents.folder.string(), ": ", stacks.size(),
                      " series; choose one with --series N: ", listed(contents, all_of(contents)));
  }
  const auto index = std::size_t(choice.series) - 1;
  if (!stacks[index].fault.empty()) throw input_error(stacks[index].fault);
  if (!shows(stacks[index], choice.side)) {
    throw input_error(contents.folder.string(), ": series ", contents.numbered(index),
                      " does not show the ", side_name(*choice.side), " breast");
  }
  return index;
}

/// The scans that show as much as the best, whatever their contrast, if they are of several patients or
/// examinations, between which there is no choice by a rule; otherwise nothing.
std::vector<std::size_t> of_several(const Contents& contents, std::size_t best,
                                    const ScanChoice& choice) {
  const DicomStack& taken = contents.stacks[best];
  std::vector<std::size_t> rivals;
  bool of_one = true;
  for (std::size_t n = 0; n < contents.stacks.size(); ++n) {
    const DicomStack& other = contents.stacks[n];
    if (!is_candidate(other, choice) || is_large(other) != is_large(taken)) continue;
    rivals.push_back(n);
    of_one = of_one && other.first().patient_id == taken.first().patient_id &&
             other.first().study_uid == taken.first().study_uid;
  }
  if (of_one) rivals.clear();
  return rivals;
}

std::size_t best_index(const Contents& contents, const ScanChoice& choice) {
  const std::vector<std::size_t> best = best_of(contents, choice);
  if (best.empty()) throw none_of(contents, choice);
  if (const auto rivals = of_several(contents, best.front(), choice); !rivals.empty()) {
    throw input_error(contents.folder.string(),
                      ": scans of several patients or examinations; give the folder of one, or "
                      "choose with --series N: ",
                      listed(contents, rivals));
  }
  if (best.size() > 1) {
    throw input_error(
        contents.folder.string(), ": ", best.size(), " of ", contents.stacks.size(),
        " series are equally good; choose one with --series N: ", listed(contents, best));
  }
  return best.front();
}

std::string use_of(const Contents& contents, std::size_t n, const std::vector<std::size_t>& best,
                   bool several, const ScanChoice& choice) {
  const DicomStack& stack = contents.stacks[n];
  if (!stack.fault.empty()) return "no: " + stack.fault;
  if (is_localiser(stack)) return "only if asked for: a localiser";
  if (!shows(stack, choice.side))
    return message("no: does not show the ", side_name(*choice.side), " breast");
  if (std::find(best.begin(), best.end(), n) == best.end()) return "if asked for";
  if (several)
    return "if asked for: one of the best, but there are several patients or examinations";
  return best.size() == 1 ? "taken" : "if asked for: one of the best";
}

}  // namespace

ChosenStack chosen_stack(const fs::path& folder, const ScanChoice& choice) {
  Contents contents = contents_of(folder);
  const std::size_t index = choice.series > 0 && !contents.stacks.empty()
                                ? asked_for(contents, choice)
                                : best_index(contents, choice);
  ChosenStack chosen;
  chosen.remarks = passed_over(contents);
  if (choice.series == 0 && contents.stacks.size() > 1) {
    chosen.remarks.push_back(message(folder.string(), ": series ", contents.numbered(index), " (",
                                     contrast_name(contents.stacks[index].first().contrast),
                                     ") is taken of ", contents.stacks.size(),
                                     "; --list shows the others, --series N takes another"));
    for (std::size_t n = 0; n < contents.stacks.size(); ++n) {
      const DicomStack& other = contents.stacks[n];
      if (!other.fault.empty() && other.slices.size() >= contents.stacks[index].slices.size() / 2)
        chosen.remarks.push_back(message("series ", n + 1, " is no volume: ", other.fault));
    }
  }
  chosen.number = int(index) + 1;
  chosen.stack = std::move(contents.stacks[index]);
  return chosen;
}

SeriesList list_stacks(const fs::path& folder, const ScanChoice& choice) {
  const Contents contents = contents_of(folder);
  SeriesList list;
  list.table.columns = {"series",   "images",     "pixels", "voxel_mm",
                        "contrast", "time_point", "sides",  "use"};
  const std::vector<std::size_t> best = best_of(contents, choice);
  const bool several = !best.empty() && !of_several(contents, best.front(), choice).empty();
  for (std::size_t n = 0; n < contents.stacks.size(); ++n) {
    const DicomStack& stack = contents.stacks[n];
    const DicomImage& first = stack.first();
    const bool placed = stack.fault.empty();
    list.table.rows.push_back({std::to_string(n + 1), std::to_string(stack.slices.size()),
                               message(first.columns, " x ", first.rows),
                               placed ? message(first.pixel[1], " x ", first.pixel[0], " x ",
                                                format_fixed(stack.thickness(), 3))
                                      : std::string(empty_cell),
                               contrast_name(first.contrast),
                               message(stack.time, " of ", stack.times),
                               !placed ? std::string(empty_cell)
                                       : std::string(stack.side ? side_name(*stack.side) : "both"),
                               use_of(contents, n, best, several, choice)});
  }
  if (contents.stacks.empty()) throw none_of(contents, choice);
  list.remarks = passed_over(contents);
  return list;
}

}  // namespace breast
