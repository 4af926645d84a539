// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a Document from the bytes of an HDF5 file, top down: load_document, parse, Loader. Before HDF5 may
// read a list of attributes or the chunks of a dataset, check/ looks at their bytes, on which HDF5 crashes
// when they are damaged.
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>
#include <set>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/guarded_child.hpp"
#include "io/hdf5/check/attribute_check.hpp"
#include "io/hdf5/check/chunk_check.hpp"
#include "io/hdf5/fields.hpp"
#include "io/hdf5/handle.hpp"
#include "io/hdf5/packed.hpp"
#include "io/hdf5/seal.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

template <class T>
void check_finite(const Complaint& complain, const std::string& path, const Array& array,
                  const std::vector<T>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw complain("dataset ", path, index_text(i, array.shape), " is ", values[i],
                     ", must be finite");
    }
  }
}

void check_all_finite(const Complaint& complain, const Document& document) {
  for (const auto* list : {&document.datasets, &document.attributes}) {
    for (const auto& [path, array] : *list) {
      if (const auto* d = std::get_if<Doubles>(&array.values))
        check_finite(complain, path, array, *d);
      if (const auto* f = std::get_if<Floats>(&array.values))
        check_finite(complain, path, array, *f);
    }
  }
}

// A string of the file as stored: up to the first NUL, without space padding.
std::string stored_text(const char* text, std::size_t size) {
  std::string out(text, strnlen(text, size));
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

// What all values of a file may take in memory.
constexpr std::size_t most_bytes = std::size_t(1) << 30;
// Deflate reaches at most 1032:1 (zlib's own statement).
constexpr std::size_t most_inflation = 1100;

// What HDF5 may take for a file of that size: the values twice, as they are and packed. A damaged list of
// members, which has no end, would otherwise take gigabytes or minutes.
struct Budget {
  double memory_mb, cpu_seconds;
};
Budget budget_of(std::size_t file_bytes) {
  constexpr double base_mb = 512, most_mb = 3072, mb = 1 << 20;
  constexpr double base_seconds = 5, mb_a_second = 100;
  const double memory =
      std::min(most_mb, base_mb + 2.0 * double(most_inflation) * double(file_bytes) / mb);
  return {memory, base_seconds + (memory - base_mb) / mb_a_second};
}

// What a file states of the values of a dataset or attribute.
struct Stated {
  std::string path;
  std::vector<std::size_t> shape;
  std::size_t count = 1;  // of values
  H5T_class_t kind = H5T_NO_CLASS;
  std::size_t width = 0;  // bytes of a value
};

class Loader {
 public:
  Loader(const Complaint& complain, std::string_view file) : complain_(complain), file_(file) {}

  /// All below the group at a path from the root of `file`, which is `depth` groups deep.
  void load_group(const Handle& file, const std::string& path, int depth) {
    if (depth > 8) throw complain_("group ", path, " is nested too deeply");
    Handle group(H5Gopen2(file, path.c_str(), H5P_DEFAULT), H5Gclose);
    if (!group) throw complain_("group ", path, " cannot be opened");
    load_attributes(group, path);
    H5G_info_t info{};
    if (H5Gget_info(group, &info) < 0) throw complain_("group ", path, " cannot be listed");
    if (info.nlinks > 1000) throw complain_("group ", path, " holds ", info.nlinks, " members");
    for (hsize_t i = 0; i < info.nlinks; ++i) load_member(file, group, path, i, depth);
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
      throw complain_("member ", i, " of group ", path, " cannot be read");
    }
    const std::string child = path + "/" + name;
    if (link.type != H5L_TYPE_HARD) throw complain_(child, " is a link, must be a dataset");
    H5O_info_t object{};
    if (H5Oget_info_by_name(group, name, &object, H5P_DEFAULT) < 0)
      throw complain_(child, " cannot be read");
    if (!visited_.insert(object.addr).second) {
      throw complain_(child, " is a second link to an object that has another name already");
    }
    if (object.type == H5O_TYPE_GROUP) {
      load_group(file, child, depth + 1);
    } else if (object.type == H5O_TYPE_DATASET) {
      load_dataset(group, name, child);
    } else {
      throw complain_(child, " is neither a group nor a dataset");
    }
  }

  // What the file states of the values of a dataset or attribute; refused when it could not hold them.
  Stated stated(const std::string& path, const Handle& space, const Handle& type) {
    // HDF5 reads a null dataspace as no value at all, which would leave the zero that was there.
    if (space && H5Sget_simple_extent_type(space) == H5S_NULL)
      throw complain_(path, " is there without a value");
    const int rank = space ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank < 0 || rank > 4) throw complain_(path, " has ", rank, " dimensions");
    std::vector<hsize_t> extent(std::size_t(rank) + 1);
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    Stated of{path, {extent.begin(), extent.begin() + rank}};
    const std::size_t limit = most_inflation * file_.size();
    for (const std::size_t n : of.shape) {
      if (n != 0 && of.count > limit / n) {
        throw complain_(path, " states more values than a file of ", file_.size(),
                        " bytes can hold");
      }
      of.count *= n;
    }
    of.kind = type ? H5Tget_class(type) : H5T_NO_CLASS;
    of.width = type ? H5Tget_size(type) : 0;
    if (of.kind != H5T_INTEGER && of.kind != H5T_FLOAT && of.kind != H5T_STRING)
      throw complain_("dataset ", path, " has a type that is neither number nor text");
    return of;
  }

  void load_dataset(const Handle& group, const char* name, const std::string& path) {
    const Handle dataset(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
    if (!dataset) throw complain_("dataset ", path, " cannot be opened");
    const Handle space(H5Dget_space(dataset), H5Sclose), type(H5Dget_type(dataset), H5Tclose);
    const Stated of = stated(path, space, type);
    expect_stored(dataset, of);
    document.datasets[path] = values(of, type, [&](hid_t memory, void* data) {
      return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    });
  }

  // All that must be so before HDF5 may read the values of a dataset.
  void expect_stored(const Handle& dataset, const Stated& of) {
    const auto refuse = [&](const auto&... words) {
      return complain_("dataset ", of.path, " ", words...);
    };
    const Handle layout(H5Dget_create_plist(dataset), H5Pclose);
    const H5D_layout_t kind = layout ? H5Pget_layout(layout) : H5D_LAYOUT_ERROR;
    const bool chunked = kind == H5D_CHUNKED;
    if (kind == H5D_VIRTUAL || (kind == H5D_CONTIGUOUS && H5Pget_external_count(layout) != 0))
      throw refuse("keeps its values in another file, which is not read");
    if (kind != H5D_COMPACT && kind != H5D_CONTIGUOUS && !chunked)
      throw refuse("has an unknown layout");
    if (chunked) {
      const std::string wrong = wrong_layout(layout, of.width);
      if (!wrong.empty()) throw refuse(wrong);
    }
    // HDF5 reads beyond the end of a compact dataset that is too short.
    const hsize_t stored = H5Dget_storage_size(dataset);
    if (of.count > 0 && stored == 0) throw refuse("was declared but never written");
    const hsize_t most = chunked ? most_inflation * std::min<hsize_t>(stored, file_.size())
                                 : stored / std::max<std::size_t>(of.width, 1);
    if (of.count > most) throw refuse("states ", of.count, " values in ", stored, " bytes");
    spend(of);
    if (!chunked) return;
    // Chunks are inflated to be counted, so only once the values are known to fit in memory.
    const std::string wrong = wrong_chunks(dataset, layout, of.width, file_);
    if (!wrong.empty()) throw refuse(wrong);
  }

  // Counts what a dataset or attribute will take against the whole file's budget.
  void spend(const Stated& of) {
    const std::size_t width =
        of.kind == H5T_INTEGER && of.width > 1 ? sizeof(std::int64_t) : of.width;
    if (width > 0 && of.count > (most_bytes - spent_) / width) {
      throw complain_(of.path, " and the objects before it need more than ", most_bytes,
                      " bytes of memory");
    }
    spent_ += of.count * width;
  }

  void load_attributes(const Handle& group, const std::string& path) {
    H5O_info_t info{};
    if (H5Oget_info(group, &info) < 0 || info.num_attrs > 1000)
      throw complain_("attributes of group ", path, " cannot be read");
    const std::string wrong = wrong_attributes(file_, info.addr);
    if (!wrong.empty()) throw complain_("group ", path, " is damaged: ", wrong);
    for (hsize_t i = 0; i < info.num_attrs; ++i) {
      const Handle attribute(
          H5Aopen_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
          H5Aclose);
      char name[256] = "";
      if (!attribute || H5Aget_name(attribute, sizeof name, name) < 0) {
        throw complain_("attribute ", i, " of group ", path, " cannot be read");
      }
      const std::string whole = path + "@" + name;
      const Handle space(H5Aget_space(attribute), H5Sclose);
      const Handle type(H5Aget_type(attribute), H5Tclose);
      const Stated of = stated(whole, space, type);
      spend(of);
      document.attributes[whole] = values(
          of, type, [&](hid_t memory, void* data) { return H5Aread(attribute, memory, data); });
    }
  }

  template <class Read>
  Array values(const Stated& of, const Handle& type, const Read& read) {
    const auto filled = [&](auto list, hid_t memory) {
      list.resize(of.count);
      fill(of, list.data(), memory, read);
      return list;
    };
    Array array{of.shape, Bytes()};
    if (of.kind == H5T_STRING) {
      array.values = H5Tis_variable_str(type) > 0 ? variable_texts(of, type, read)
                                                  : fixed_texts(of, type, read);
    } else if (of.kind == H5T_FLOAT) {
      if (of.width <= 4)
        array.values = filled(Floats(), H5T_NATIVE_FLOAT);
      else
        array.values = filled(Doubles(), H5T_NATIVE_DOUBLE);
    } else if (of.width == 1 && H5Tget_sign(type) == H5T_SGN_NONE) {
      array.values = filled(Bytes(), H5T_NATIVE_UINT8);
    } else {
      array.values = filled(Integers(), H5T_NATIVE_INT64);
    }
    return array;
  }

  template <class Read>
  void fill(const Stated& of, void* data, hid_t memory, const Read& read) {
    if (of.count > 0 && read(memory, data) < 0)
      throw complain_("dataset ", of.path, " cannot be read (truncated or damaged)");
  }

  template <class Read>
  Texts fixed_texts(const Stated& of, const Handle& type, const Read& read) {
    if (of.width == 0 || of.width > most_inflation * file_.size() / (of.count + 1))
      throw complain_("dataset ", of.path, " states texts longer than the file");
    std::vector<char> buffer(of.count * of.width);
    fill(of, buffer.data(), type, read);
    Texts texts;
    for (std::size_t i = 0; i < of.count; ++i)
      texts.push_back(stored_text(buffer.data() + i * of.width, of.width));
    return texts;
  }

  // Other programs (h5py) store texts of variable length.
  template <class Read>
  Texts variable_texts(const Stated& of, const Handle& type, const Read& read) {
    std::vector<char*> pointers(of.count, nullptr);
    fill(of, pointers.data(), type, read);
    Texts texts;
    for (char* text : pointers) {
      texts.emplace_back(text ? text : "");
      H5free_memory(text);
    }
    return texts;
  }

  const Complaint& complain_;
  std::string_view file_;
  std::size_t spent_ = 0;
  std::set<haddr_t> visited_;
};

void check_schema(const Complaint& complain, const Document& document, const std::string& schema) {
  const auto found = document.attributes.find("/breast@schema");
  const Texts* texts =
      found == document.attributes.end() ? nullptr : std::get_if<Texts>(&found->second.values);
  if (!texts || texts->size() != 1)
    throw complain("attribute schema of group /breast is missing, must be '", schema, "'");
  if (texts->front() != schema)
    throw complain("has schema '", texts->front(), "', must be '", schema, "'");
}

// The part HDF5 does, whose 1.10 parser can crash on damage: in a child process.
Document parse(const Complaint& complain, std::string& content,
               const std::set<std::string>& groups = {"/VTKHDF", "/breast"}) {
  silence_hdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = std::size_t(1) << 16;
  H5Pset_fapl_core(access, growth, false);
  H5Pset_file_image(access, content.data(), content.size());
  const Handle h5(H5Fopen("in memory", H5F_ACC_RDONLY, access), H5Fclose);
  if (!h5) throw complain("HDF5 cannot open it (truncated or damaged)");
  Loader loader(complain, content);
  for (const std::string& group : groups) {
    if (H5Lexists(h5, group.c_str(), H5P_DEFAULT) <= 0)
      throw complain("group ", group, " is missing: this is not a file of libbreast");
    H5L_info_t link{};
    if (H5Lget_info(h5, group.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) {
      throw complain(group, " is a link, must be a group");
    }
    loader.load_group(h5, group, 0);
  }
  return std::move(loader.document);
}

}  // namespace

Document load_document(const fs::path& file, const std::string& schema, const std::string& maker) {
  const Complaint complain{ErrorKind::input, file.string(), "; make it with " + maker};
  try {
    std::string content = read_text(file);
    check_seal(content, complain.file, complain.advice);
    const std::lock_guard lock(hdf5_mutex());
    constexpr double longest_s = 300;
    const auto work = [&] {
      const Document parsed = parse(complain, content);
      check_schema(complain, parsed, schema);
      return packed(parsed);
    };
    const Budget budget = budget_of(content.size());
    Document document = unpacked(
        in_guarded_child(complain.file, work, longest_s, budget.memory_mb, budget.cpu_seconds));
    check_all_finite(complain, document);
    return document;
  } catch (const std::bad_alloc&) {
    throw complain("declares more data than fit in memory");
  }
}

bool reads_back(const std::string& name, std::string& image, const Document& document) {
  std::set<std::string> groups;
  for (const auto& [path, array] : document.datasets)
    groups.insert(path.substr(0, path.find_first_of("/@", 1)));
  for (const auto& [path, array] : document.attributes)
    groups.insert(path.substr(0, path.find_first_of("/@", 1)));
  const Document found = parse({ErrorKind::input, name, ""}, image, groups);
  const auto equal = [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.shape == b.second.shape &&
           a.second.values == b.second.values;
  };
  const auto same = [&](const auto& a, const auto& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
  };
  return same(found.datasets, document.datasets) && same(found.attributes, document.attributes);
}

void check_writable(const fs::path& file, const Document& document) {
  check_all_finite({ErrorKind::failed, "cannot write " + file.string(), ""}, document);
}

}  // namespace breast
