// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "distributed/bytes.hpp"
#include "distributed/distributed.hpp"
#include "mechanics/model.hpp"

namespace breast {

namespace {

std::vector<char> packed(const MechanicsOptions& options) {
  ByteWriter out;
  const ModelText model = model_text(options);
  for (const auto& [name, text] : model_parts) {
    const std::string& words = model.*text;
    out(std::vector<char>(words.begin(), words.end()));
  }
  out(options.solver);
  out(options.estimate);
  out(options.seek_remedy);
  return out.take();
}

MechanicsOptions unpacked(const std::vector<char>& bytes) {
  ByteReader in(bytes);
  ModelText model;
  for (const auto& [name, text] : model_parts) {
    std::vector<char> words;
    in(words);
    (model.*text).assign(words.begin(), words.end());
  }
  MechanicsOptions options = stated_model(model, "the model of the first process");
  in(options.solver);
  in(options.estimate);
  in(options.seek_remedy);
  return options;
}

}  // namespace

MechanicsOptions shared_options(const Ranks& ranks, const MechanicsOptions& of_root) {
  std::vector<char> bytes;
  if (ranks.root()) bytes = packed(of_root);
  ranks.broadcast(bytes);
  return unpacked(bytes);
}

}  // namespace breast
