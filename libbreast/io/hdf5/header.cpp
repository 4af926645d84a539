// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/fields.hpp"

namespace breast {

namespace {
const std::string units = "mm-g-s", orientation = "LPS";

void put_history(Document& document, const History& history) {
  Texts tools, versions, commands, names, digests;
  Integers entries;
  for (std::size_t i = 0; i < history.size(); ++i) {
    tools.push_back(history[i].tool);
    versions.push_back(history[i].version);
    commands.push_back(history[i].command);
    for (const InputRecord& input : history[i].inputs) {
      entries.push_back(std::int64_t(i));
      names.push_back(input.name);
      digests.push_back(input.sha256);
    }
  }
  auto& sets = document.datasets;
  sets["/breast/history/tool"] = array_of(std::move(tools));
  sets["/breast/history/version"] = array_of(std::move(versions));
  sets["/breast/history/command"] = array_of(std::move(commands));
  sets["/breast/history/input_entry"] = array_of(std::move(entries));
  sets["/breast/history/input_name"] = array_of(std::move(names));
  sets["/breast/history/input_sha256"] = array_of(std::move(digests));
}

History get_history(Fields& fields) {
  const Texts tools = fields.texts("/breast/history/tool", {Fields::any});
  const Texts versions = fields.texts("/breast/history/version", {tools.size()});
  const Texts commands = fields.texts("/breast/history/command", {tools.size()});
  const std::vector<int> entries =
      fields.indices("/breast/history/input_entry", {Fields::any}, 0, long(tools.size()));
  const Texts names = fields.texts("/breast/history/input_name", {entries.size()});
  const Texts digests = fields.texts("/breast/history/input_sha256", {entries.size()});
  History history;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    history.push_back({tools[i], versions[i], commands[i], {}});
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    history[std::size_t(entries[i])].inputs.push_back({names[i], digests[i]});
  }
  return history;
}
}  // namespace

void put_header(Document& document, const FileHeader& header) {
  auto& attributes = document.attributes;
  attributes["/breast@schema"] = array_of(header.schema);
  attributes["/breast@units"] = array_of(units);
  attributes["/breast@orientation"] = array_of(orientation);
  attributes["/breast@side"] = array_of(std::string(side_name(header.side)));
  const bool known = !header.history.empty();
  attributes["/breast@tool"] = array_of(known ? header.history.back().tool : std::string());
  attributes["/breast@version"] = array_of(known ? header.history.back().version : std::string());
  put_history(document, header.history);
}

FileHeader get_header(Fields& fields) {
  FileHeader header;
  header.schema = fields.text("/breast@schema");
  for (const auto& [path, wanted] : {std::pair<std::string, std::string>{"/breast@units", units},
                                     {"/breast@orientation", orientation}}) {
    const std::string found = fields.text(path);
    if (found != wanted) {
      throw fields.complain()("attribute ", path, " is '", found, "', must be '", wanted, "'");
    }
  }
  const std::string side = fields.text("/breast@side");
  if (side != "left" && side != "right") {
    throw fields.complain()("attribute /breast@side is '", side, "', must be 'left' or 'right'");
  }
  header.side = side_from_name(side);
  header.history = get_history(fields);
  return header;
}

}  // namespace breast
