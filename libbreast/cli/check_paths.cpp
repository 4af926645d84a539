// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the files of a command that are possible before any of them is opened.
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "cli/parse.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/text/lower_case.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// Arguments of the command line, with what they are for.
struct NamedPath {
  const Argument* argument;
  fs::path path, whole;  ///< as given; absolute, without links
};

std::vector<NamedPath> named_paths(const Declaration& tool, const Tokens& tokens) {
  std::vector<NamedPath> list;
  const auto add = [&](const Argument& argument, const std::string& value) {
    std::error_code ignored;
    fs::path bare = value;
    if (!bare.has_filename()) bare = bare.parent_path();  // "truth/"
    list.push_back({&argument, value, fs::weakly_canonical(bare, ignored)});
  };
  for (std::size_t i = 0; i < tokens.positionals.size() && !tool.positionals.empty(); ++i) {
    add(tool.positionals[std::min(i, tool.positionals.size() - 1)], tokens.positionals[i]);
  }
  for (const Tokens::Option& option : tokens.options) {
    const Argument* argument = find_option(const_cast<Declaration&>(tool), option.name);
    if (argument == nullptr) continue;
    for (const std::string& value : option.values) add(*argument, value);
  }
  return list;
}

bool is_output(const Argument& argument) {
  return argument.kind == ArgumentKind::output || argument.kind == ArgumentKind::folder;
}

// A text may be the name of a file, such as a table of materials or a spectrum.
bool may_be_read(const NamedPath& named) {
  if (named.argument->kind == ArgumentKind::input) return true;
  std::error_code ignored;
  return named.argument->kind == ArgumentKind::text && fs::exists(named.path, ignored);
}

// "; `backward` makes it" for a file of the chain, which is known by its name.
std::string maker_of(const fs::path& path) {
  const std::string name = path.filename().string();
  for (const auto& [file, tool] : {std::pair("labels.vtkhdf", "segment"),
                                   {"points.vtp", "segment"},
                                   {"geometry.vtkhdf", "fit-hermite"},
                                   {"mesh.vtkhdf", "hexmesh"},
                                   {"reference.vtkhdf", "backward"},
                                   {"supine.vtkhdf", "forward"},
                                   {"cc.vtkhdf", "compress"},
                                   {"mlo.vtkhdf", "compress"},
                                   {"cc.vti", "project-mammogram"},
                                   {"mlo.vti", "project-mammogram"},
                                   {"curve.vtp", "cc2mlo"},
                                   {"lookup.h5", "match-lookup"}})
    if (name == file) return message("; `", tool, "` makes it");
  return "";
}

void check_input(const fs::path& path, const std::string& label) {
  std::error_code reason;
  const fs::file_status status = fs::status(path, reason);
  if (!fs::exists(status))
    throw input_error(label, ": ", path.string(), " does not exist", maker_of(path));
  if (!fs::is_regular_file(status) && !fs::is_directory(status)) {
    throw input_error(label, ": ", path.string(),
                      " is a device or pipe; copy its content to a file first");
  }
  if (access(path.c_str(), R_OK) != 0) {
    throw input_error(label, ": ", path.string(), " cannot be read (no permission)");
  }
}

void check_ending(const fs::path& path, const Argument& argument) {
  const std::string name = lower_case(path.filename().string());
  const auto& endings = argument.endings;
  const bool known = std::any_of(endings.begin(), endings.end(), [&](const std::string& ending) {
    return name.size() > ending.size() && name.ends_with(lower_case(ending));
  });
  if (known || endings.empty()) return;
  std::string list;
  for (const std::string& ending : endings) list += (list.empty() ? "" : ", ") + ending;
  throw input_error(argument.label(), ": ", path.string(), ": the name must end with ", list,
                    ", which states its format");
}

void check_output(const fs::path& path, const Argument& argument) {
  if (is_stream(path)) return;
  const bool folder = argument.kind == ArgumentKind::folder;
  const std::string& label = argument.label();
  std::error_code reason;
  fs::path bare = path;
  if (folder && !bare.has_filename()) bare = bare.parent_path();  // "truth/"
  const fs::path parent = bare.has_parent_path() ? bare.parent_path() : fs::path(".");
  if (!bare.has_filename()) throw input_error(label, ": ", path.string(), " names no file");
  if (!fs::is_directory(parent, reason)) {
    throw input_error(label, ": folder ", parent.string(), " does not exist; make it first");
  }
  if (access(parent.c_str(), W_OK | X_OK) != 0) {
    throw input_error(label, ": folder ", parent.string(), " is not writable");
  }
  const bool is_folder = fs::is_directory(bare, reason);
  if (!folder && is_folder) throw input_error(label, ": ", path.string(), " is a folder");
  if (folder && !is_folder && fs::exists(bare, reason)) {
    throw input_error(label, ": ", path.string(), " exists and is not a folder");
  }
  if (folder) return;
  check_ending(path, argument);
  check_replaceable(path, label);
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

void check_against_input(const NamedPath& output, const NamedPath& input) {
  std::error_code ignored;
  const std::string& label = output.argument->label();
  const std::string& input_label = input.argument->label();
  if (output.whole == input.whole) {
    throw input_error(label, ": ", output.path.filename().string(), " is also the input ",
                      input_label, "; give another output");
  }
  const bool folder = fs::is_directory(input.whole, ignored);
  if (folder && input.argument->kind == ArgumentKind::input && lies_in(output.whole, input.whole)) {
    throw input_error(label, ": ", output.path.string(), " lies in the input folder ", input_label,
                      "; give an output elsewhere");
  }
}

}  // namespace

void check_paths(const Declaration& tool, const Tokens& tokens) {
  const std::vector<NamedPath> list = named_paths(tool, tokens);
  for (const NamedPath& named : list) {
    if (named.argument->kind == ArgumentKind::input) {
      check_input(named.path, named.argument->label());
    }
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!is_output(*list[i].argument)) continue;
    for (std::size_t j = 0; j < list.size(); ++j) {
      if (may_be_read(list[j])) check_against_input(list[i], list[j]);
      if (j < i && is_output(*list[j].argument) && list[i].whole == list[j].whole &&
          !is_stream(list[i].path)) {
        throw input_error(list[i].argument->label(), ": ", list[i].path.string(),
                          " is also given as ", list[j].argument->label());
      }
    }
    check_output(list[i].path, *list[i].argument);
  }
}

}  // namespace breast
