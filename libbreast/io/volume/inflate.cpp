// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/volume/inflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <fstream>

#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

class Counter {
 public:
  Counter(const fs::path& file, double most_bytes) : file_(file), most_bytes_(most_bytes) {}

  void add(std::size_t count) {
    content.bytes += double(count);
    if (content.bytes > most_bytes_) {
      throw input_error(file_.string(), ": holds more than ", most_bytes_,
                        " bytes, the number that its header states");
    }
  }
  Content content;

 private:
  const fs::path& file_;
  double most_bytes_;
};

/// Inflates the members of a gzip stream up to the last one's checksum and length, which zlib
/// compares. gzread will not do: it takes a stream cut inside them for whole.
class Inflater {
 public:
  Inflater(const fs::path& file, std::ifstream& in) : file_(file), in_(in) {
    constexpr int gzip_only = 15 + 16;
    if (inflateInit2(&z_, gzip_only) != Z_OK)
      throw failed_error(file.string(), ": zlib cannot be started");
  }
  ~Inflater() { inflateEnd(&z_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void run(Counter& counter) {
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
      counter.add(out_.size() - z_.avail_out);
    }
  }

 private:
  void refill() {
    in_.read(reinterpret_cast<char*>(in_buffer_.data()), std::streamsize(in_buffer_.size()));
    z_.next_in = in_buffer_.data();
    z_.avail_in = unsigned(in_.gcount());
  }
  // Whatever else follows a gzip stream is padding.
  bool another_member() {
    if (z_.avail_in == 0) refill();
    return z_.avail_in > 0 && *z_.next_in == 0x1f;
  }

  const fs::path& file_;
  std::ifstream& in_;
  z_stream z_{};
  std::vector<unsigned char> in_buffer_ = std::vector<unsigned char>(1 << 16),
                             out_ = std::vector<unsigned char>(1 << 18);
};

}  // namespace

Content content_from(const fs::path& file, std::streamoff start, double most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in.seekg(start)) throw input_error(file.string(), ": cannot be opened");
  char magic[2] = {};
  in.read(magic, 2);
  in.clear();
  in.seekg(start);
  Counter counter(file, most_bytes);
  counter.content.compressed = magic[0] == '\x1f' && magic[1] == '\x8b';
  if (counter.content.compressed) {
    Inflater(file, in).run(counter);
    return counter.content;
  }
  std::vector<unsigned char> buffer(1 << 18);
  while (in) {
    in.read(reinterpret_cast<char*>(buffer.data()), std::streamsize(buffer.size()));
    counter.add(std::size_t(in.gcount()));
  }
  return counter.content;
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
