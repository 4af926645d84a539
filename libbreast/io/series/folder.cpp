// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/folder.hpp"

#include <algorithm>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/dicom/storage_class.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 200000;

std::vector<fs::path> files_below(const fs::path& folder, int& links) {
  std::vector<fs::path> files;
  std::error_code none;
  if (fs::is_regular_file(folder, none)) return {folder};
  const auto options = fs::directory_options::skip_permission_denied;
  for (auto entry = fs::recursive_directory_iterator(folder, options);
       entry != fs::recursive_directory_iterator(); ++entry) {
    std::error_code unreachable;  // a link that leads nowhere, or to itself
    const std::string name = entry->path().filename().string();
    if (name.starts_with(".")) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file(unreachable)) {
      if (name != "DICOMDIR") files.push_back(entry->path());
    } else if (entry->is_symlink(unreachable) && entry->is_directory(unreachable)) {
      ++links;
    }
    if (files.size() > most_files) {
      throw input_error(folder.string(), ": more than ", most_files,
                        " files below it; give the folder of one examination");
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The class as the data set states it, else the meta information, as of a DICOMDIR.
std::string class_of(const DicomObject& object) {
  const std::string stated = text_of(object.header, "0008|0016");
  return stated.empty() ? text_of(object.header, "0002|0002") : stated;
}

/// Whether an instance was seen in another file with the same content, as in exports that hold a series
/// twice.
bool is_copy(const fs::path& file, const DicomObject& object,
             std::multimap<std::string, fs::path>& instances) {
  const std::string uid = text_of(object.header, "0008|0018");
  if (uid.empty()) return false;
  const auto [first, last] = instances.equal_range(uid);
  for (auto seen = first; seen != last; ++seen) {
    std::error_code gone;
    if (fs::file_size(seen->second, gone) == fs::file_size(file, gone) &&
        read_text(seen->second) == read_text(file))
      return true;
  }
  instances.emplace(uid, file);
  return false;
}

}  // namespace

DicomFolder find_images(const fs::path& folder) {
  DicomFolder found;
  std::multimap<std::string, fs::path> instances;
  for (const fs::path& file : files_below(folder, found.folders_not_followed)) {
    DicomObject object;
    try {
      if (!read_dicom_object(file, object)) {
        if (file.extension() != ".dcm") {
          found.others.push_back(file);
          continue;
        }
        throw input_error(file.string(), ": not a DICOM file (empty, truncated or foreign)");
      }
    } catch (const Error& error) {
      // What has no pixels is passed over whether it is whole or not.
      const std::string sop_class = class_of(object);
      if (!sop_class.empty() && !is_image_class(sop_class)) {
        ++found.without_pixels[object_kind(sop_class)];
        continue;
      }
      found.damaged.push_back({text_of(object.header, "0020|000e"), error.what()});
      continue;
    }
    if (!object.pixels) {
      ++found.without_pixels[object_kind(class_of(object))];
    } else if (is_copy(file, object, instances)) {
      ++found.copies;
    } else {
      for (DicomImage& image : images_of(file, object)) found.images.push_back(std::move(image));
    }
  }
  return found;
}

}  // namespace breast
