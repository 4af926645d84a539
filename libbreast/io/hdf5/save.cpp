// SPDX-License-Identifier: GPL-3.0-or-later
// Document -> HDF5 bytes: the same document always gives the same bytes.
#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "io/hdf5/document.hpp"
#include "io/hdf5/handle.hpp"
#include "io/hdf5/seal.hpp"

namespace breast {

void check_writable(const std::filesystem::path& file, const Document& document);
/// True when the bytes of an HDF5 file hold that document and nothing else; may throw as load_document does.
bool reads_back(const std::string& name, std::string& image, const Document& document);

namespace {

constexpr std::size_t compact_bytes = 1024;  // stored inside the object header
constexpr std::size_t wanted_chunk_bytes = std::size_t(1) << 20;
constexpr unsigned deflate_level = 2;  // beyond it the time grows, the file hardly shrinks

std::size_t text_width(const Texts& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  return width;
}

// Memory and file type of an array; texts have the length of the longest, padded with NUL.
Handle type_of(const Array& array) {
  const auto copy = [](hid_t type) { return Handle(H5Tcopy(type), H5Tclose); };
  if (std::holds_alternative<Bytes>(array.values)) return copy(H5T_STD_U8LE);
  if (std::holds_alternative<Integers>(array.values)) return copy(H5T_STD_I64LE);
  if (std::holds_alternative<Floats>(array.values)) return copy(H5T_IEEE_F32LE);
  if (std::holds_alternative<Doubles>(array.values)) return copy(H5T_IEEE_F64LE);
  Handle text = copy(H5T_C_S1);
  H5Tset_size(text, text_width(std::get<Texts>(array.values)));
  H5Tset_strpad(text, H5T_STR_NULLPAD);
  const Texts& texts = std::get<Texts>(array.values);
  const bool ascii = std::all_of(texts.begin(), texts.end(), [](const std::string& t) {
    return std::all_of(t.begin(), t.end(), [](char c) { return static_cast<signed char>(c) >= 0; });
  });
  // VTK's reader asks for ASCII in its own attributes.
  if (!ascii) H5Tset_cset(text, H5T_CSET_UTF8);
  return text;
}

// Pointer to the values as H5Dwrite wants them; `buffer` holds padded texts.
const void* data_of(const Array& array, std::vector<char>& buffer) {
  if (const auto* texts = std::get_if<Texts>(&array.values)) {
    const std::size_t width = text_width(*texts);
    buffer.assign(std::max<std::size_t>(texts->size() * width, 1), '\0');
    for (std::size_t i = 0; i < texts->size(); ++i) {
      std::memcpy(buffer.data() + i * width, (*texts)[i].data(), (*texts)[i].size());
    }
    return buffer.data();
  }
  return std::visit([](const auto& values) -> const void* { return values.data(); }, array.values);
}

Handle space_of(const Array& array) {
  if (array.shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  const std::vector<hsize_t> extent(array.shape.begin(), array.shape.end());
  return {H5Screate_simple(int(extent.size()), extent.data(), nullptr), H5Sclose};
}

// Small arrays are compact, large ones deflated in chunks of whole rows (slices of a volume).
Handle layout_of(const Array& array, std::size_t value_bytes) {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  const std::size_t bytes = array.size() * value_bytes;
  if (bytes <= compact_bytes && bytes > 0) {
    H5Pset_layout(properties, H5D_COMPACT);
  } else if (bytes > compact_bytes) {
    std::vector<hsize_t> chunk(array.shape.begin(), array.shape.end());
    const std::size_t row = std::max<std::size_t>(bytes / array.shape[0], 1);
    chunk[0] = std::clamp<hsize_t>(wanted_chunk_bytes / row, 1, array.shape[0]);
    H5Pset_chunk(properties, int(chunk.size()), chunk.data());
    if (value_bytes > 1 && !std::holds_alternative<Texts>(array.values)) H5Pset_shuffle(properties);
    H5Pset_deflate(properties, deflate_level);
  }
  return properties;
}

class Saver {
 public:
  Saver(const Handle& file, const std::string& name) : file_(file), name_(name) {}

  void dataset(const std::string& path, const Array& array) {
    make_groups(path.substr(0, path.rfind('/')));
    const Handle type = type_of(array), space = space_of(array);
    const Handle layout = layout_of(array, H5Tget_size(type));
    const Handle dataset(
        H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
    std::vector<char> buffer;
    const void* data = data_of(array, buffer);
    if (!dataset ||
        (array.size() > 0 && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)) {
      throw refuse(path);
    }
  }

  void attribute(const std::string& path, const Array& array) {
    const std::size_t at = path.rfind('@');
    make_groups(path.substr(0, at));
    const Handle group(H5Gopen2(file_, path.substr(0, at).c_str(), H5P_DEFAULT), H5Gclose);
    const Handle type = type_of(array), space = space_of(array);
    const Handle attribute(
        H5Acreate2(group, path.c_str() + at + 1, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    std::vector<char> buffer;
    if (!attribute || H5Awrite(attribute, type, data_of(array, buffer)) < 0) throw refuse(path);
  }

 private:
  void make_groups(const std::string& path) {
    if (path.empty() || groups_.contains(path)) return;
    make_groups(path.substr(0, path.rfind('/')));
    const Handle group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Gclose);
    if (!group) throw refuse(path);
    groups_.insert(path);
  }
  Error refuse(const std::string& path) const {
    return failed_error(name_, ": ", path, " cannot be written in memory");
  }

  const Handle& file_;
  std::string name_;
  std::set<std::string> groups_;
};

// The file in memory: HDF5 crashes when a disk is full, so that it never sees one.
std::string hdf5_image(const std::string& name, const Document& document) {
  silence_hdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = std::size_t(1) << 22;
  constexpr hbool_t on_disk = false;
  H5Pset_fapl_core(access, growth, on_disk);
  const Handle h5(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  if (!h5) throw failed_error(name, ": HDF5 cannot make a file in memory");
  Saver saver(h5, name);
  for (const auto& [path, array] : document.attributes) saver.attribute(path, array);
  for (const auto& [path, array] : document.datasets) saver.dataset(path, array);
  const ssize_t size = H5Fflush(h5, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(h5, nullptr, 0);
  std::string image(std::size_t(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(h5, image.data(), image.size()) != size) {
    throw failed_error(name, ": HDF5 cannot finish the file in memory");
  }
  return image;
}

}  // namespace

// HDF5 without memory leaves datasets out without a word, crashes, or prints when the program ends: so a child process
// makes the bytes, and reads them back.
void save_document(const std::filesystem::path& file, const Document& document) {
  check_writable(file, document);
  const std::lock_guard lock(hdf5_mutex());
  const std::string name = file.string();
  const auto work = [&] {
    std::string image = hdf5_image(name, document);
    if (!reads_back(name, image, document)) {
      throw failed_error(name, ": cannot be written: HDF5 does not read back what it was given");
    }
    return image;
  };
  std::string image;
  try {
    image = in_guarded_child(name, work);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::failed) throw;
    throw failed_error(name, ": cannot be written: HDF5 crashed or ran out of memory");
  }
  write_bytes(file, sealed(std::move(image)));
}

}  // namespace breast
