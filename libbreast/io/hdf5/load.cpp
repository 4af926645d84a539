// The only file that speaks HDF5 for reading.
#include <hdf5.h>

#include <cmath>
#include <mutex>
#include <new>

#include "core/atomic_file.hpp"
#include "io/hdf5/document.hpp"
#include "io/hdf5/handle.hpp"
#include "io/hdf5/seal.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

struct Source {
  std::string name;    ///< file, as messages call it
  std::string advice;  ///< "; make it again with hexmesh"

  template <class... Parts>
  Error refuse(const Parts&... parts) const {
    return input_error(name, ": ", parts..., advice);
  }
};

template <class T>
void check_finite(const Source& source, const std::string& path, const Array& array,
                  const std::vector<T>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw source.refuse("dataset ", path, index_text(i, array.shape), " is ", values[i],
                          ", must be finite");
    }
  }
}

void check_all_finite(const Source& source, const Document& document) {
  for (const auto* list : {&document.datasets, &document.attributes}) {
    for (const auto& [path, array] : *list) {
      if (const auto* d = std::get_if<Doubles>(&array.values))
        check_finite(source, path, array, *d);
      if (const auto* f = std::get_if<Floats>(&array.values)) check_finite(source, path, array, *f);
    }
  }
}

// A string of the file as stored: up to the first NUL, without space padding.
std::string stored_text(const char* text, std::size_t size) {
  std::string out(text, strnlen(text, size));
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

class Loader {
 public:
  Loader(const Source& source, std::size_t file_bytes) : source_(source), file_bytes_(file_bytes) {}

  void load_group(const Handle& parent, const std::string& path, int depth) {
    if (depth > 8) throw source_.refuse("group ", path, " is nested too deeply");
    Handle group(H5Gopen2(parent, path.c_str(), H5P_DEFAULT), H5Gclose);
    if (!group) throw source_.refuse("group ", path, " cannot be opened");
    load_attributes(group, path);
    H5G_info_t info{};
    if (H5Gget_info(group, &info) < 0) throw source_.refuse("group ", path, " cannot be listed");
    if (info.nlinks > 1000)
      throw source_.refuse("group ", path, " holds ", info.nlinks, " members");
    for (hsize_t i = 0; i < info.nlinks; ++i) load_member(parent, group, path, i, depth);
  }

  Document document;

 private:
  void load_member(const Handle& file, const Handle& group, const std::string& path, hsize_t i,
                   int depth) {
    char name[256];
    H5L_info_t link{};
    if (H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name, sizeof name,
                           H5P_DEFAULT) < 0 ||
        H5Lget_info(group, name, &link, H5P_DEFAULT) < 0) {
      throw source_.refuse("member ", i, " of group ", path, " cannot be read");
    }
    const std::string child = path + "/" + name;
    if (link.type != H5L_TYPE_HARD) throw source_.refuse(child, " is a link, must be a dataset");
    H5O_info_t object{};
    if (H5Oget_info_by_name(group, name, &object, H5P_DEFAULT) < 0) {
      throw source_.refuse(child, " cannot be read");
    }
    if (object.type == H5O_TYPE_GROUP) {
      load_group(file, child, depth + 1);
    } else if (object.type == H5O_TYPE_DATASET) {
      load_dataset(group, name, child);
    } else {
      throw source_.refuse(child, " is neither a group nor a dataset");
    }
  }

  // Shape of a dataspace, refused when the file could not possibly hold it.
  std::vector<std::size_t> shape_of(const Handle& space, const std::string& path) {
    const int rank = space ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank < 0 || rank > 4) throw source_.refuse(path, " has ", rank, " dimensions");
    std::vector<hsize_t> extent(std::size_t(rank) + 1);
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    std::vector<std::size_t> shape(extent.begin(), extent.begin() + rank);
    std::size_t count = 1;
    // Deflate reaches at most 1032:1 (zlib's own statement).
    const std::size_t limit = 1100 * file_bytes_;
    for (const std::size_t n : shape) {
      if (n != 0 && count > limit / n) {
        throw source_.refuse(path, " states more values than a file of ", file_bytes_,
                             " bytes can hold");
      }
      count *= n;
    }
    return shape;
  }

  void load_dataset(const Handle& group, const char* name, const std::string& path) {
    const Handle dataset(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
    if (!dataset) throw source_.refuse("dataset ", path, " cannot be opened");
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const auto read = [&](hid_t memory, void* data) {
      return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    };
    Array array = read_values(path, shape_of(space, path), type, read);
    if (array.size() > 0 && H5Dget_storage_size(dataset) == 0) {
      throw source_.refuse("dataset ", path, " was declared but never written");
    }
    document.datasets[path] = std::move(array);
  }

  void load_attributes(const Handle& group, const std::string& path) {
    H5O_info_t info{};
    if (H5Oget_info(group, &info) < 0 || info.num_attrs > 1000) {
      throw source_.refuse("attributes of group ", path, " cannot be read");
    }
    for (hsize_t i = 0; i < info.num_attrs; ++i) {
      const Handle attribute(
          H5Aopen_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
          H5Aclose);
      char name[256] = "";
      if (!attribute || H5Aget_name(attribute, sizeof name, name) < 0) {
        throw source_.refuse("attribute ", i, " of group ", path, " cannot be read");
      }
      const std::string whole = path + "@" + name;
      const Handle space(H5Aget_space(attribute), H5Sclose);
      const Handle type(H5Aget_type(attribute), H5Tclose);
      document.attributes[whole] =
          read_values(whole, shape_of(space, whole), type,
                      [&](hid_t memory, void* data) { return H5Aread(attribute, memory, data); });
    }
  }

  template <class Read>
  Array read_values(const std::string& path, const std::vector<std::size_t>& shape,
                    const Handle& type, const Read& read) {
    std::size_t count = 1;
    for (const std::size_t n : shape) count *= n;
    Array array{shape, Bytes()};
    const auto fill = [&](auto values, hid_t memory) {
      values.resize(count);
      if (count > 0 && read(memory, values.data()) < 0) {
        throw source_.refuse("dataset ", path, " cannot be read (truncated or damaged)");
      }
      array.values = std::move(values);
    };
    const H5T_class_t kind = type ? H5Tget_class(type) : H5T_NO_CLASS;
    const std::size_t width = type ? H5Tget_size(type) : 0;
    if (kind == H5T_INTEGER && width == 1 && H5Tget_sign(type) == H5T_SGN_NONE) {
      fill(Bytes(), H5T_NATIVE_UINT8);
    } else if (kind == H5T_INTEGER) {
      fill(Integers(), H5T_NATIVE_INT64);
    } else if (kind == H5T_FLOAT && width <= 4) {
      fill(Floats(), H5T_NATIVE_FLOAT);
    } else if (kind == H5T_FLOAT) {
      fill(Doubles(), H5T_NATIVE_DOUBLE);
    } else if (kind == H5T_STRING) {
      array.values = H5Tis_variable_str(type) > 0 ? read_variable_texts(path, count, type, read)
                                                  : read_fixed_texts(path, count, type, read);
    } else {
      throw source_.refuse("dataset ", path, " has a type that is neither number nor text");
    }
    return array;
  }

  template <class Read>
  Texts read_fixed_texts(const std::string& path, std::size_t count, const Handle& type,
                         const Read& read) {
    const std::size_t width = H5Tget_size(type);
    if (width == 0 || width > 1100 * file_bytes_ / (count + 1)) {
      throw source_.refuse("dataset ", path, " states texts longer than the file");
    }
    std::vector<char> buffer(count * width);
    if (count > 0 && read(type, buffer.data()) < 0) {
      throw source_.refuse("dataset ", path, " cannot be read (truncated or damaged)");
    }
    Texts texts;
    for (std::size_t i = 0; i < count; ++i) {
      texts.push_back(stored_text(buffer.data() + i * width, width));
    }
    return texts;
  }

  // Other programs (h5py) store texts of variable length.
  template <class Read>
  Texts read_variable_texts(const std::string& path, std::size_t count, const Handle& type,
                            const Read& read) {
    std::vector<char*> pointers(count, nullptr);
    if (count > 0 && read(type, pointers.data()) < 0) {
      throw source_.refuse("dataset ", path, " cannot be read (truncated or damaged)");
    }
    Texts texts;
    for (char* text : pointers) {
      texts.emplace_back(text ? text : "");
      H5free_memory(text);
    }
    return texts;
  }

  const Source& source_;
  std::size_t file_bytes_;
};

void check_schema(const Source& source, const Document& document, const std::string& schema) {
  const auto found = document.attributes.find("/breast@schema");
  const Texts* texts =
      found == document.attributes.end() ? nullptr : std::get_if<Texts>(&found->second.values);
  if (!texts || texts->size() != 1) {
    throw source.refuse("attribute schema of group /breast is missing, must be '", schema, "'");
  }
  if (texts->front() != schema) {
    throw source.refuse("has schema '", texts->front(), "', must be '", schema, "'");
  }
}

}  // namespace

Document load_document(const fs::path& file, const std::string& schema, const std::string& maker) {
  const Source source{file.string(), "; make it with " + maker};
  try {
    check_seal(read_text(file), source.name, source.advice);
    const std::lock_guard lock(hdf5_mutex());
    silence_hdf5();
    const Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!h5) throw source.refuse("HDF5 cannot open it (truncated or damaged)");
    Loader loader(source, fs::file_size(file));
    for (const char* group : {"/VTKHDF", "/breast"}) {
      if (H5Lexists(h5, group, H5P_DEFAULT) <= 0) {
        throw source.refuse("group ", group, " is missing: not a file of libbreast");
      }
      loader.load_group(h5, group, 0);
    }
    check_schema(source, loader.document, schema);
    check_all_finite(source, loader.document);
    return std::move(loader.document);
  } catch (const std::bad_alloc&) {
    throw source.refuse("states more data than fits in memory");
  }
}

void check_writable(const fs::path& file, const Document& document) {
  try {
    check_all_finite({file.string(), ""}, document);
  } catch (const Error& error) {
    throw failed_error("cannot write ", error.what());
  }
}

}  // namespace breast
