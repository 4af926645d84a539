// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 against published vectors; tables, numbers, reports, histories, atomic files.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/distances.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/provenance.hpp"
#include "core/report.hpp"
#include "core/sha256.hpp"
#include "core/table.hpp"
#include "core/types.hpp"
#include "core/units.hpp"
#include "fixtures/scratch_folder.hpp"
#include "mesh/view.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

std::string sha256(const std::string& text, std::size_t piece) {
  Sha256 hash;
  for (std::size_t i = 0; i < text.size(); i += piece) {
    hash.update(text.data() + i, std::min(piece, text.size() - i));
  }
  return hash.hex();
}

// FIPS 180-4 examples (NIST CSRC).
TEST(Sha256Digest, KnownVectors) {
  const std::pair<std::string, const char*> vectors[] = {
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
      {std::string(1000000, 'a'),
       "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"}};
  for (const auto& [text, digest] : vectors) {
    for (const std::size_t piece :
         {std::size_t(1), std::size_t(63), std::size_t(64), std::size_t(1000)}) {
      EXPECT_EQ(sha256(text, piece), digest);
    }
  }
}

TEST(Provenance, HistoriesMergeInOrderWithoutRepeats) {
  const HistoryEntry a{"segment", "1", "segment a", {{"mr", "1"}}},
      b{"hexmesh", "1", "hexmesh b", {}};
  const History one = {a}, two = {a, b};
  const History merged = extend_history({&one, &two}, {"forward", "1", "forward c", {}});
  ASSERT_EQ(merged.size(), 3u);
  EXPECT_EQ(merged[0].tool, "segment");
  EXPECT_EQ(merged[1].tool, "hexmesh");
  EXPECT_EQ(merged[2].tool, "forward");
}

TEST(Tables, CutAtALineEndIsRefused) {
  const Table whole{{"name", "x_mm"}, {{"nipple", "1"}, {"tumour", "2"}}};
  const std::string text = whole.closed_text();
  EXPECT_TRUE(parse_table(text, "t.tsv").closed);
  for (std::size_t length = text.find('\n') + 1; length < text.size(); ++length) {
    if (text[length - 1] != '\n' && text[length - 1] != '\r') continue;
    EXPECT_FALSE(parse_table(text.substr(0, length), "t.tsv").closed) << length;
  }
  EXPECT_FALSE(parse_table("name\tx_mm\r\nnipple\t1\r\n\r\n", "t.tsv").closed)
      << "every line of another program's ends so";
  try {
    parse_table(text, "t.tsv").column("y_mm");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "t.tsv has no column 'y_mm'; it has: name, x_mm");
  }
}

// A cell takes 32 bytes of memory and more, a tab one of the file.
TEST(Tables, FilesLargerThanAnyTableAreRefused) {
  const ScratchFolder folder;
  write_text(folder / "t.tsv", "a\n1\n");
  std::filesystem::resize_file(folder / "t.tsv", std::uintmax_t(17) << 20);
  try {
    read_table(folder / "t.tsv");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("at most"), std::string::npos) << error.what();
  }
}

TEST(Tables, WhatWouldReadBackOtherwiseIsNotWritten) {
  const auto reason = [](const Table& table) {
    try {
      table.text();
      return std::string();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::failed);
      return std::string(error.what());
    }
  };
  const std::vector<std::string> header{"name", "x_mm"};
  EXPECT_EQ(reason({header, {{"", "1"}, {"b", ""}}}), "");  // an empty name keeps its column
  EXPECT_NE(reason({header, {{"a", "1"}, {"b\tc", "2"}}}), "");
  EXPECT_NE(reason({header, {{"a\nb", "1"}}}), "");
  EXPECT_NE(reason({header, {{"a", "1\r"}}}), "");
  EXPECT_EQ((Table{header, {{"a", "-inf"}}}.text()), "name\tx_mm\na\t\n");  // no such number
  EXPECT_NE(reason({header, {{"a", "1", "2"}}}), "");
  EXPECT_NE(reason({header, {{"a", "1"}, {"# comment", "2"}}}), "");
  EXPECT_NE(reason({header, {{"#1", "2"}}}).find("row 1, '#1'"), std::string::npos);
}

TEST(AtomicFolders, TheLastFileStandsForTheWhole) {
  ScratchFolder scratch;
  const auto target = scratch.path() / "truth";
  const std::string ours = "\n\r\n";
  const auto fill = [&](const AtomicFolder& folder, const std::string& what) {
    write_text(folder.temporary() / "a.txt", what + ours);
    write_text(folder.temporary() / "last.tsv", what + ours);
  };
  {
    AtomicFolder folder(target, "last.tsv");
    fill(folder, "one");
  }
  EXPECT_FALSE(std::filesystem::exists(target));
  {
    AtomicFolder folder(target, "last.tsv");
    fill(folder, "one");
    folder.commit();
  }
  write_text(target / "other.txt", "somebody else's");
  {
    AtomicFolder folder(target, "last.tsv");
    write_text(folder.temporary() / "a.txt", "two" + ours);
    EXPECT_THROW(folder.commit(), Error);  // no last file
  }
  EXPECT_FALSE(std::filesystem::exists(target / "last.tsv"));
  EXPECT_EQ(read_text(target / "other.txt"), "somebody else's");
  for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
    EXPECT_EQ(entry.path(), target);
}

TEST(Tables, RoundTripAndRefusals) {
  const Table table = parse_table("# by hand\nname\tx_mm\r\nnipple\t1.5\n\ntumour\t\n", "t.tsv");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1][1], "-");
  EXPECT_EQ(table.column("x_mm"), 1);
  EXPECT_EQ(table.text(), "name\tx_mm\nnipple\t1.5\ntumour\t\n");
  EXPECT_THROW(table.column("y_mm"), Error);
  EXPECT_THROW(parse_table("", "t.tsv"), Error);
  for (const char* cell : {"nan", "-inf", "NaN", "infinity"}) {
    EXPECT_THROW(parse_table(std::string("name\tx_mm\nnipple\t") + cell + "\n", "t.tsv"), Error);
  }
  try {
    parse_table("a\tb\n1\t2\n3\n", "t.tsv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "t.tsv: line 3 has 1 columns, the header has 2");
  }
}

TEST(DistanceSummary, KnownValuesInAnyOrder) {
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(37 * i % 100);
  const Distances alike = summarise(values);
  EXPECT_NEAR(alike.mean_mm, 49.5, 1e-12);
  EXPECT_EQ(alike.p95_mm, 94) << "95 of 100 values are at most 94";
  EXPECT_EQ(alike.max_mm, 99);
  EXPECT_EQ(summarise(std::vector<double>{}).max_mm, 0);
}

TEST(DistanceSummary, WeighsByArea) {
  const Distances sized = summarise({WeightedDistance{3, 1}, {1, 18}, {2, 1}});
  EXPECT_NEAR(sized.mean_mm, 23.0 / 20, 1e-12);
  EXPECT_EQ(sized.p95_mm, 2);
  EXPECT_EQ(sized.max_mm, 3);
  EXPECT_EQ(summarise({WeightedDistance{5, 0}}).max_mm, 0) << "no weight, nothing to tell";
}

TEST(Numbers, ShortestTextReadsBack) {
  for (const double x : {0.1, 1.0 / 3, 1e-300, -123456789.123456789, 5e-324}) {
    EXPECT_EQ(parse_number(format_number(x), "x"), x);
  }
  for (const char* bad : {"", "nan", "inf", "1.5mm", " 1", "1e999", "0x10"}) {
    EXPECT_THROW(parse_number(bad, "x"), Error) << bad;
  }
}

TEST(Reports, NestOrderAndNull) {
  Report report;
  report.set("status", "ok");
  report.set("seconds/total", 1.5);
  report.set("residual", std::nan(""));
  report.append("warnings", "one");
  report.append("warnings", "two");
  const Report back = Report::parse(report.json(), "r.json");
  EXPECT_EQ(back.json(), report.json());
  EXPECT_EQ(back.number("seconds/total"), 1.5);
  EXPECT_EQ(back.text("residual"), "null");
  EXPECT_THROW(back.number("residual"), Error);
  EXPECT_THROW(back.number("absent"), Error);
  EXPECT_THROW(Report::parse("{\"status\": ", "r.json"), Error);
  EXPECT_THROW(Report::parse("[1]", "r.json"), Error);
}

TEST(Reports, DeepNestingIsRefused) {
  constexpr int deep = 100000;
  const std::string lists = std::string(deep, '[') + std::string(deep, ']');
  EXPECT_THROW(Report::parse("{\"a\": " + lists + "}", "r.json"), Error);
  EXPECT_EQ(Report::parse("{\"a\": [[[1]]]}", "r.json").text("a"), "[[[1]]]");
}

TEST(Names, TissuesSidesPostures) {
  for (int t = 0; t < n_tissues; ++t) {
    EXPECT_EQ(tissue_from_name(tissue_name(static_cast<Tissue>(t))), static_cast<Tissue>(t));
  }
  EXPECT_THROW(tissue_from_name("gland"), Error);
  EXPECT_THROW(side_from_name("both"), Error);
  EXPECT_EQ(posture_gravity(Posture::supine), Vec3(0, 9810, 0));
  for (const Posture posture :
       {Posture::prone, Posture::supine, Posture::upright, Posture::weightless}) {
    EXPECT_EQ(posture_from_name(posture_name(posture)), posture);
  }
  EXPECT_THROW(posture_from_name("sitting"), Error);
}

TEST(Names, Views) {
  for (const View view : {View::cc, View::mlo, View::ml}) {
    EXPECT_EQ(view_named(view_name(view)), view);
  }
  EXPECT_EQ(view_name(View::mlo), "MLO");
  EXPECT_EQ(view_column(View::mlo), "mlo");
  EXPECT_EQ(view_angle_deg(View::ml), 90);
  EXPECT_FALSE(view_from_name("cc"));
  try {
    view_named("LM");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "unknown view 'LM'; use CC, MLO or ML");
    EXPECT_EQ(error.exit_code(), 2);
  }
}

TEST(Reports, HoldAnyNameAndAnyBytes) {
  Report report;
  report.set("landmarks/a~b/displacement_mm", 1.5);
  report.set("landmarks//displacement_mm", 2.5);
  report.set("reason", "Br\xfcste.dcm: no slices");  // Latin-1
  report.append("warnings", "\xff\xfe");
  const Report read = Report::parse(report.json(), "report");
  EXPECT_EQ(read.number("landmarks/a~b/displacement_mm"), 1.5);
  EXPECT_EQ(read.number("landmarks//displacement_mm"), 2.5);
  EXPECT_EQ(read.text("reason"), "Br\xef\xbf\xbdste.dcm: no slices");
  EXPECT_FALSE(read.contains("reason/deeper"));
}

TEST(AtomicFolders, AnotherProgramsFileStays) {
  const ScratchFolder scratch;
  const fs::path target = scratch / "truth";
  fs::create_directory(target);
  write_text(target / "last.tsv", "a table of mine\n");
  EXPECT_THROW(AtomicFolder(target, "last.tsv"), Error);
  EXPECT_EQ(read_text(target / "last.tsv"), "a table of mine\n");
}

// In a child that may write files of at most `bytes`; the parent's files stay as they were.
void write_with_limit(const fs::path& file, const std::string& text, rlim_t bytes,
                      std::string& error) {
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_text(file, text);
    } catch (const Error& thrown) {
      const std::string what = thrown.what();
      if (write(report[1], what.data(), what.size()) < 0) _exit(9);
    }
    _exit(0);
  }
  close(report[1]);
  char buffer[1000];
  for (ssize_t n; (n = read(report[0], buffer, sizeof buffer)) > 0;) error.append(buffer, n);
  close(report[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(AtomicFiles, AFullDiskLeavesTheOldFileAndSaysWhereItStopped) {
  const ScratchFolder folder;
  const std::string text(5000, 'x');
  for (const rlim_t bytes : {0, 1, 4095, 4999, 5000}) {
    write_text(folder / "result", "old");
    std::string error;
    write_with_limit(folder / "result", text, bytes, error);
    EXPECT_EQ(read_text(folder / "result"), bytes < 5000 ? "old" : text) << bytes;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << bytes;
    const std::string where = std::to_string(bytes) + " of 5000 bytes";
    EXPECT_EQ(error.find(where) != std::string::npos, bytes < 5000) << error;
  }
}

TEST(AtomicFiles, ANameMayBeAsLongAsTheSystemAllows) {
  const ScratchFolder folder;
  for (const std::size_t bytes : {std::size_t(254), std::size_t(255)}) {
    const fs::path file = folder / std::string(bytes, 'n');
    write_text(file, "once");
    write_text(file, "twice");
    EXPECT_EQ(read_text(file), "twice");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST(AtomicFiles, DevicesAndStreamsAreWrittenThrough) {
  const ScratchFolder folder;
  write_text("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_symlink("/dev/null", folder / "sink");
  write_text(folder / "sink", "x");
  EXPECT_TRUE(fs::is_symlink(folder / "sink"));
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int reader = open((folder / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  write_text(folder / "pipe", "through");
  char buffer[16] = {};
  EXPECT_EQ(read(reader, buffer, sizeof buffer), 7);
  EXPECT_STREQ(buffer, "through");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  EXPECT_TRUE(is_stream("/dev/stdout"));
  EXPECT_TRUE(is_stream("/dev/fd/1"));
  EXPECT_FALSE(is_stream(folder / "absent"));
  EXPECT_THROW(write_text("/dev/full", "x"), Error);
}

TEST(AtomicFiles, DevicesAndPipesAreNotRead) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(read_text(folder / "pipe"), Error);
  EXPECT_THROW(read_text("/dev/zero"), Error);
  write_text(folder / "large", std::string(100, 'x'));
  EXPECT_THROW(read_text(folder / "large", 99), Error);
  EXPECT_EQ(read_text(folder / "large", 100).size(), 100u);
}

TEST(AtomicFiles, PartsOfDeadProcessesGo) {
  const ScratchFolder folder;
  const pid_t dead = fork();
  if (dead == 0) _exit(0);
  waitpid(dead, nullptr, 0);
  const fs::path stale = folder / (".result.part-" + std::to_string(dead));
  const fs::path alive = folder / (".result.part-" + std::to_string(getppid()));
  const fs::path other = folder / (".another.part-" + std::to_string(dead));
  const fs::path notes = folder / ".result.part-notes";  // a user's, by chance
  for (const fs::path& file : {stale, alive, other, notes}) std::ofstream(file) << "x";
  write_text(folder / "result", "new");
  EXPECT_TRUE(fs::exists(notes));
  EXPECT_FALSE(fs::exists(stale));
  EXPECT_TRUE(fs::exists(alive));
  EXPECT_TRUE(fs::exists(other));
}

TEST(OwnFiles, AreKnownByTheirContent) {
  const ScratchFolder folder;
  const auto ours = [&](const std::string& content) {
    write_text(folder / "file", content);
    return written_by_us(folder / "file");
  };
  EXPECT_TRUE(ours(""));
  EXPECT_TRUE(ours("a\tb\n1\t2\n\r\n"));
  EXPECT_FALSE(ours("a\tb\n1\t2\n\n"));
  EXPECT_FALSE(ours("a\tb\r\n1\t2\r\n\r\n")) << "a table of Windows that ends with an empty line";
  EXPECT_TRUE(ours("{\n  \"tool\": \"segment\"\n}\n"));
  EXPECT_TRUE(ours("NRRD0004\n# written by libbreast\n"));
  EXPECT_TRUE(ours("** Written by libbreast.\n"));
  EXPECT_FALSE(ours("a\tb\n1\t2\n"));
  EXPECT_FALSE(ours("{\"name\": \"tool\"}"));
  EXPECT_FALSE(ours("NRRD0004\n# by another program\n"));
  EXPECT_FALSE(ours("# Notes on libbreast\n"));
  EXPECT_FALSE(ours(std::string("\x89PNG\r\n\x1a\n", 8) + std::string(100, '\0')));
  EXPECT_FALSE(ours(std::string("\x89HDF\r\n\x1a\n", 8) + std::string(100, '\0')));
  EXPECT_FALSE(written_by_us(folder / "absent"));
}

TEST(AtomicFiles, UnwritablePlacesFailInOneLine) {
  EXPECT_THROW(write_text("/nonexistent-folder/result", "x"), Error);
  EXPECT_THROW(read_text("/nonexistent-folder/result"), Error);
}

}  // namespace
}  // namespace breast
