// SPDX-License-Identifier: GPL-3.0-or-later
// The run of a tool: questions such as --help, parsing, checks, body, report, exit code.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <span>

#include "cli/last_words.hpp"
#include "cli/library_words.hpp"
#include "cli/parse.hpp"
#include "cli/preflight.hpp"
#include "cli/progress_sink.hpp"
#include "cli/tool_impl.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/files_written.hpp"
#include "core/own_file.hpp"
#include "core/parallel.hpp"

namespace breast {

namespace {

// Runs before main(), because the tool's own options may be what does not fit in memory.
[[maybe_unused]] const bool prepared = has_preflight() && have_last_words();

// Text from a file that a message quotes must not contain control sequences for the terminal.
std::string printable_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
  }
  return text;
}

// One number of threads for OpenMP, ITK and VTK; the latter two read their environment late.
void apply_threads(int threads) {
  set_threads(threads);
  const std::string count = std::to_string(breast::threads());
  setenv("ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS", count.c_str(), 1);
  setenv("VTK_SMP_MAX_THREADS", count.c_str(), 1);
}

const char* failure_status(ErrorKind kind) {
  if (kind == ErrorKind::input) return "bad_input";
  return kind == ErrorKind::not_converged ? "not_converged" : "failed";
}

struct Outcome {
  int exit_code = 0;
  std::string status, reason;  ///< set in failure only
};

// Runs `work` and turns whatever it throws into an outcome.
Outcome guarded(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const Error& error) {
    return {error.exit_code(), failure_status(error.kind()), printable_line(error.what())};
  } catch (const std::bad_alloc&) {
    return {1, "failed", "out of memory"};
  } catch (const std::exception& error) {
    return {1, "failed", printable_line(error.what())};
  } catch (...) {
    return {1, "failed", "unknown failure"};
  }
}

void write_stdout(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw failed_error("stdout cannot be written");
  }
}

// A report may be sent to somebody: it names files, not the folders they lie in.
std::string without_folders(std::string text, const Tokens& tokens) {
  std::vector<std::string> given = tokens.positionals;
  for (const Tokens::Option& option : tokens.options) {
    given.insert(given.end(), option.values.begin(), option.values.end());
  }
  for (const std::string& value : given) {
    const std::size_t slash = value.find_last_of('/');
    if (slash == std::string::npos || slash == 0) continue;
    const std::string folder = value.substr(0, slash + 1);
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
      text.erase(at, folder.size());
  }
  return text;
}

/// The files and folders that were given as arguments of this kind.
std::vector<std::filesystem::path> given_files(const Declaration& tool, const Tokens& tokens,
                                               ArgumentKind kind) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const Argument& argument, const std::string& value) {
    if (argument.kind != kind) return;
    const std::filesystem::path file = value;
    files.push_back(file.has_filename() ? file : file.parent_path());
  };
  for (std::size_t i = 0; i < tokens.positionals.size() && !tool.positionals.empty(); ++i)
    add(tool.positionals[std::min(i, tool.positionals.size() - 1)], tokens.positionals[i]);
  for (const Tokens::Option& option : tokens.options) {
    for (const Argument& argument : tool.options) {
      if (argument.label() != option.name) continue;
      for (const std::string& value : option.values) add(argument, value);
    }
  }
  return files;
}

/// Their names, without the folders they lie in.
std::vector<std::string> input_names(const Declaration& tool, const Tokens& tokens) {
  std::vector<std::string> names;
  for (const auto& file : given_files(tool, tokens, ArgumentKind::input))
    names.push_back(file.filename().string());
  return names;
}

/// Removes those outputs, and files named after them (NAME-summary.tsv), that this process has written
/// after the first `earlier` files: some of a run's files beside older ones would look like a result.
void remove_outputs(const Declaration& tool, const Tokens& tokens, std::size_t earlier) {
  const std::vector<std::filesystem::path> written = files_written();
  for (const auto& file : std::span(written).subspan(earlier)) {
    for (const auto& output : given_files(tool, tokens, ArgumentKind::output)) {
      const bool named_after = file.parent_path() == output.parent_path() &&
                               file.filename().string().starts_with(output.stem().string());
      std::error_code ignored;
      if (named_after) std::filesystem::remove(file, ignored);
    }
  }
}

void write_report(const std::filesystem::path& file, Run& run, const Outcome& outcome,
                  const Tokens& tokens) {
  Report& report = run.report();
  if (outcome.exit_code != 0) {
    // A solve that did not converge has already recorded its typed reason.
    const bool typed = outcome.exit_code == 3 && report.contains("explanation");
    if (!typed) {
      report.set("status", outcome.status);
      report.set("reason", without_folders(outcome.reason, tokens));
    }
  }
  run.timer().write(report);
  report.set("seconds/total", run.seconds());
  report.set("cpu_seconds", cpu_seconds());
  report.set("peak_mb", peak_memory_mb());
  if (!file.empty()) write_text(file, report.json());
}

// After a usage error the report is still written, unless its own path may be what was wrong: a
// report must never replace a file named for another purpose, nor one that is no report.
bool safe_report(const std::filesystem::path& file, const Tokens& tokens) {
  if (file.empty()) return false;
  if (is_stream(file)) return true;
  std::error_code ignored;
  if (file.extension() != ".json") return false;
  if (std::filesystem::exists(file, ignored) && !written_by_us(file)) return false;
  const auto whole = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(path, ignored);
  };
  std::vector<std::string> others = tokens.positionals;
  for (const Tokens::Option& option : tokens.options) {
    if (option.name != "--report")
      others.insert(others.end(), option.values.begin(), option.values.end());
  }
  return std::none_of(others.begin(), others.end(),
                      [&](const std::string& other) { return whole(other) == whole(file); });
}

}  // namespace

void Tool::Impl::declare_common() {
  const auto add_common = [&](ArgumentKind kind, const char* name, const char* placeholder,
                              const char* help) -> Argument& {
    Argument argument;
    argument.kind = kind;
    argument.names = {name};
    argument.placeholder = placeholder;
    argument.help = help;
    declaration.common.push_back(argument);
    return declaration.common.back();
  };
  add_common(ArgumentKind::output, "--report", "FILE.json",
             "write a machine-readable report, also in case of failure")
      .endings = {".json"};
  declaration.common.back().store = [this](const std::vector<std::string>& given) {
    report_file = given.front();
  };
  Argument& count = add_common(ArgumentKind::integer, "--threads", "N", "number of threads");
  count.low = 1;
  count.high = 1024;
  count.default_text = "all cores";
  count.store = [this](const std::vector<std::string>& given) {
    threads = std::stoi(given.front());
  };
  add_common(ArgumentKind::flag, "--quiet", "", "print no progress and no warnings on stderr")
      .store = [this](const std::vector<std::string>&) { quiet = true; };
  const auto nothing = [](const std::vector<std::string>&) {};
  add_common(ArgumentKind::flag, "--help", "", "print a short help").store = nothing;
  add_common(ArgumentKind::flag, "--help-all", "",
             "print the whole description and all options by topic")
      .store = nothing;
  add_common(ArgumentKind::flag, "--version", "", "print the name and version").store = nothing;
}

bool Tool::Impl::answer_questions(const std::vector<std::string>& arguments) const {
  const auto asked = [&](const char* name) {
    const auto end = std::find(arguments.begin(), arguments.end(), "--");
    return std::find(arguments.begin(), end, name) != end;
  };
  std::string answer;
  if (asked("--help"))
    answer = help_text(declaration, false);
  else if (asked("--help-all"))
    answer = help_text(declaration, true);
  else if (asked("--version"))
    answer = declaration.name + " (libbreast) " + declaration.version + "\n";
  else if (asked("--help-completion"))
    answer = help_completion(declaration);
  if (!answer.empty()) write_stdout(answer);
  return !answer.empty();
}

int Tool::main(int argc, char** argv, const std::function<void(Run&)>& body) {
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  Declaration& declaration = impl_->declaration;
  const auto complain = [&](const Outcome& outcome) {
    dprintf(message_descriptor(), "%s: %s\n", declaration.name.c_str(), outcome.reason.c_str());
    return outcome.exit_code;
  };
  bool answered = false;
  Outcome outcome = guarded([&] { answered = impl_->answer_questions(arguments); });
  if (outcome.exit_code != 0) return complain(outcome);
  if (answered) return 0;

  const Tokens tokens = tokenize(declaration, arguments);
  outcome = guarded([&] {
    assign(declaration, tokens);
    check_paths(declaration, tokens);
    for (const auto& rule : impl_->rules) rule();
  });
  const bool report_possible = outcome.exit_code == 0 || safe_report(impl_->report_file, tokens);
  StderrProgress progress(declaration.name, impl_->quiet);
  Run run(declaration.name, history_command(declaration, arguments), progress);
  run.report().set("inputs", input_names(declaration, tokens));
  const std::size_t earlier = files_written().size();
  if (outcome.exit_code == 0) {
    apply_threads(impl_->threads);
    if (threads() > 1) sleep_when_waiting(argv);
    const LibraryWords kept_to_themselves;
    outcome = guarded([&] {
      body(run);
      write_stdout(run.printed());
    });
  }
  progress.finish(outcome.exit_code == 0);
  // A solve that did not converge writes what it has found.
  if (outcome.exit_code == 1 || outcome.exit_code == 2)
    remove_outputs(declaration, tokens, earlier);
  if (outcome.exit_code != 0) complain(outcome);
  const Outcome reported = guarded([&] {
    write_report(report_possible ? impl_->report_file : std::filesystem::path(), run, outcome,
                 tokens);
  });
  if (outcome.exit_code == 0 && reported.exit_code != 0) return complain(reported);
  return outcome.exit_code;
}

}  // namespace breast
