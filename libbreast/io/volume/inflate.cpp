// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/volume/inflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

constexpr int gzip_or_zlib = 15 + 32, raw = -15;  // window bits, as zlib takes them

/// Inflates the members of a gzip stream, or a zlib or raw stream, up to the last one's checksum and length,
/// which zlib compares. gzread will not do: it takes a stream cut inside them for whole.
class Inflater {
 public:
  Inflater(const fs::path& file, std::ifstream& in, int form = gzip_or_zlib)
      : file_(file), in_(in), form_(form) {
    if (inflateInit2(&z_, form) != Z_OK)
      throw failed_error(file.string(), ": zlib cannot be started");
  }
  ~Inflater() { inflateEnd(&z_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Bytes of the whole stream; infinity for one with more than `most_bytes`.
  double bytes(double most_bytes, std::string* kept) {
    double count = 0;
    int code = Z_OK;
    while (code != Z_STREAM_END || another_member()) {
      if (code == Z_STREAM_END) inflateReset(&z_);
      if (z_.avail_in == 0) refill();
      z_.next_out = out_.data();
      z_.avail_out = unsigned(out_.size());
      code = inflate(&z_, Z_NO_FLUSH);
      const bool stuck = code == Z_BUF_ERROR && z_.avail_in == 0 && !in_;
      if ((code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR) || stuck) {
        throw input_error(file_.string(), ": truncated or damaged compressed data");
      }
      const std::size_t now = out_.size() - z_.avail_out;
      count += double(now);
      if (count > most_bytes) return std::numeric_limits<double>::infinity();
      if (kept) kept->append(reinterpret_cast<const char*>(out_.data()), now);
    }
    return count;
  }

 private:
  void refill() {
    in_.read(reinterpret_cast<char*>(in_buffer_.data()), std::streamsize(in_buffer_.size()));
    z_.next_in = in_buffer_.data();
    z_.avail_in = unsigned(in_.gcount());
  }
  // Whatever else follows a gzip stream is padding.
  bool another_member() {
    if (form_ == raw) return false;
    if (z_.avail_in == 0) refill();
    return z_.avail_in > 0 && *z_.next_in == 0x1f;
  }

  const fs::path& file_;
  std::ifstream& in_;
  int form_;
  z_stream z_{};
  std::vector<unsigned char> in_buffer_ = std::vector<unsigned char>(1 << 16),
                             out_ = std::vector<unsigned char>(1 << 18);
};

}  // namespace

Content inflated_content(const fs::path& file, std::streamoff start, double most_bytes,
                         std::string* kept) {
  std::ifstream in(file, std::ios::binary);
  if (!in.seekg(start)) throw input_error(file.string(), ": cannot be opened");
  unsigned char magic[2] = {};
  in.read(reinterpret_cast<char*>(magic), 2);
  in.clear();
  in.seekg(start);
  const bool gzip = magic[0] == 0x1f && magic[1] == 0x8b;
  const bool zlib = (magic[0] & 0xf) == 8 && (magic[0] * 256 + magic[1]) % 31 == 0;  // RFC 1950
  if (kept) kept->clear();
  if (gzip || zlib) {
    return {Inflater(file, in).bytes(most_bytes, kept), gzip ? Packing::gzip : Packing::zlib};
  }
  const double bytes = double(fs::file_size(file)) - double(start);
  if (kept && bytes <= most_bytes) {
    kept->resize(std::size_t(bytes));
    if (!in.read(kept->data(), std::streamsize(bytes)))
      throw input_error(file.string(), ": cannot be read to its end");
  }
  return {bytes, Packing::none};
}

std::string inflated_bytes(const fs::path& file, std::streamoff start, double most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in.seekg(start)) throw input_error(file.string(), ": cannot be opened");
  std::string bytes;
  if (!(Inflater(file, in, raw).bytes(most_bytes, &bytes) <= most_bytes)) {
    throw input_error(file.string(), ": holds more than ", most_bytes, " bytes when inflated");
  }
  return bytes;
}

std::vector<unsigned char> head_of(const fs::path& file) {
  constexpr unsigned header_bytes = 600;
  std::vector<unsigned char> head(header_bytes);
  gzFile in = gzopen(file.c_str(), "rb");  // plain files too
  if (in == nullptr) throw input_error(file.string(), ": cannot be opened");
  const int count = gzread(in, head.data(), header_bytes);
  gzclose(in);
  head.resize(std::size_t(std::max(count, 0)));
  return head;
}

}  // namespace breast
