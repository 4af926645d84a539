// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/check/chunk_check.hpp"

#include <zlib.h>

#include <optional>
#include <vector>

#include "core/error.hpp"
#include "io/hdf5/handle.hpp"

namespace breast {

namespace {

constexpr std::size_t most_chunk_bytes = std::size_t(1) << 28;

/// How many bytes a zlib stream inflates to, counted up to the first piece beyond `most`; none if it is damaged.
std::optional<std::size_t> inflated_bytes(std::string_view packed, std::size_t most) {
  std::vector<unsigned char> piece(std::size_t(1) << 16);
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw failed_error("zlib cannot be started");
  stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(packed.data()));
  stream.avail_in = unsigned(packed.size());
  int code = Z_OK;
  while (code == Z_OK && stream.total_out <= most) {
    stream.next_out = piece.data();
    stream.avail_out = unsigned(piece.size());
    code = inflate(&stream, Z_NO_FLUSH);
  }
  const std::size_t bytes = stream.total_out;
  inflateEnd(&stream);
  if (code != Z_STREAM_END && bytes <= most) return {};
  return bytes;
}

std::vector<H5Z_filter_t> filters_of(hid_t layout) {
  std::vector<H5Z_filter_t> filters;
  for (int n = 0; n < H5Pget_nfilters(layout); ++n) {
    unsigned flags = 0, setting = 0;
    std::size_t settings = 0;
    filters.push_back(
        H5Pget_filter2(layout, unsigned(n), &flags, &settings, nullptr, 0, nullptr, &setting));
  }
  return filters;
}

/// How many bytes a stored chunk holds once its filters are undone; none if it is damaged. Bit n of `skipped` says that
/// filter n was not applied to this chunk.
std::optional<std::size_t> unfiltered_bytes(std::string_view stored,
                                            const std::vector<H5Z_filter_t>& filters,
                                            unsigned skipped, std::size_t most) {
  constexpr std::size_t checksum = 4;
  std::size_t bytes = stored.size();
  bool inflated = false;
  for (std::size_t n = filters.size(); n-- > 0;) {  // the last filter is undone first
    if ((skipped >> n & 1) != 0) continue;
    if (filters[n] == H5Z_FILTER_FLETCHER32) {
      if (bytes < checksum) return {};
      bytes -= checksum;
    } else if (filters[n] == H5Z_FILTER_DEFLATE) {
      if (inflated) return {};  // twice: nobody writes that
      const auto found = inflated_bytes(stored.substr(0, bytes), most + checksum);
      if (!found) return {};
      bytes = *found;
      inflated = true;
    }
  }
  return bytes;
}

/// Bytes of a whole chunk; 0 when they are too many.
std::size_t chunk_bytes(hid_t layout, std::size_t value_bytes) {
  hsize_t chunk[H5S_MAX_RANK] = {};
  const int rank = H5Pget_chunk(layout, H5S_MAX_RANK, chunk);
  std::size_t bytes = value_bytes;
  for (int d = 0; d < rank; ++d) {
    if (chunk[d] == 0 || bytes > most_chunk_bytes / chunk[d]) return 0;
    bytes *= std::size_t(chunk[d]);
  }
  return bytes;
}

}  // namespace

std::string wrong_layout(hid_t layout, std::size_t value_bytes) {
  for (const H5Z_filter_t filter : filters_of(layout)) {
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32)
      return message("is compressed by filter ", filter,
                     "; deflate, shuffle and fletcher32 are read");
  }
  if (chunk_bytes(layout, value_bytes) == 0)
    return message("has chunks of more than ", most_chunk_bytes, " bytes");
  return {};
}

std::string wrong_chunks(hid_t dataset, hid_t layout, std::size_t value_bytes,
                         std::string_view file) {
  const std::vector<H5Z_filter_t> filters = filters_of(layout);
  const std::size_t wanted = chunk_bytes(layout, value_bytes);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  hsize_t count = 0;
  if (H5Dget_num_chunks(dataset, space, &count) < 0)
    return "is damaged: its chunks cannot be listed";
  for (hsize_t n = 0; n < count; ++n) {
    hsize_t offset[H5S_MAX_RANK] = {}, bytes = 0;
    unsigned skipped = 0;
    haddr_t at = HADDR_UNDEF;
    if (H5Dget_chunk_info(dataset, space, n, offset, &skipped, &at, &bytes) < 0)
      return message("is damaged: chunk ", n, " cannot be found");
    if (at > file.size() || bytes > file.size() - at)
      return message("is damaged: chunk ", n, " lies beyond the end of the file");
    const auto found = unfiltered_bytes(file.substr(at, bytes), filters, skipped, wanted);
    if (!found) return message("is damaged: chunk ", n, " cannot be inflated");
    if (*found != wanted) {
      return message("is damaged: chunk ", n, " holds ", *found > wanted ? "more" : "fewer",
                     " than the ", wanted, " bytes of its shape and type");
    }
  }
  return {};
}

}  // namespace breast
