// SPDX-License-Identifier: GPL-3.0-or-later
// Mammograms as archives hold them, with one or two peculiarities each: every one is registered where it is,
// with what was odd stated, or refused in words that say why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <random>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/dicom_elements.hpp"
#include "fixtures/moved_mammogram.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mammogram_dicom.hpp"
#include "io/mammogram_file.hpp"
#include "matching/aligned_view.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

constexpr double pixel_mm = 0.4;
constexpr int columns = 350, rows = 470;
const Similarity known{1.01, 1.5, Vec2(-2, 16)};

/// Stored grey values, and where the pixels of the original have gone.
struct Pixels {
  int columns = 0, rows = 0;
  std::vector<std::uint16_t> values;
  std::uint16_t bright = 0, dark = 0;  ///< as stored
  std::function<Vec2(const Vec2&)> place = [](const Vec2& at) { return at; };

  std::uint16_t& at(int column, int row) {
    return values[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
  }
  /// Every pixel of the new image from one of the old; `to` is the inverse of `from`.
  void rearrange(int width, int height, const std::function<Vec2(const Vec2&)>& from,
                 const std::function<Vec2(const Vec2&)>& to) {
    Pixels old = *this;
    columns = width;
    rows = height;
    values.assign(std::size_t(width) * std::size_t(height), dark);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Vec2 source = from(Vec2(x, y));
        if (source.x() >= 0 && source.y() >= 0 && source.x() < old.columns && source.y() < old.rows)
          at(x, y) = old.at(int(source.x()), int(source.y()));
      }
    }
    place = [before = old.place, to](const Vec2& pixel) { return to(before(pixel)); };
  }
};

/// A mammogram before it is written.
struct Export {
  View view = View::mlo;
  bool for_processing = true;
  DatasetBuilder more;
  std::vector<DatasetBuilder> modifiers;
  std::string view_code_instead;
  std::vector<std::function<void(Pixels&)>> pixels;
};

struct Feature {
  const char* name;
  const char* kind;     ///< those of one kind exclude each other
  const char* refusal;  ///< words of it; "" if the image is registered
  const char* said;     ///< words of a remark or doubt; "" if it is nothing to speak of
  std::function<void(Export&)> add;
};

void fill(Pixels& image, int left, int top, int right, int bottom) {
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) image.at(x, y) = image.bright;
}

void frame(Pixels& image) {
  constexpr int width = 10;
  fill(image, 0, 0, image.columns, width);
  fill(image, 0, image.rows - width, image.columns, image.rows);
  fill(image, 0, 0, width, image.rows);
  fill(image, image.columns - width, 0, image.columns, image.rows);
}

void labels(Pixels& image) {  // bars like letters in the air, in both anterior corners
  for (int k = 0; k < 4; ++k) {
    fill(image, image.columns - 60 + 12 * k, 18, image.columns - 54 + 12 * k, 50);
    fill(image, image.columns - 60 + 12 * k, image.rows - 40, image.columns - 54 + 12 * k,
         image.rows - 20);
  }
}

void padding(Pixels& image) {
  constexpr int width = 40;
  const Vec2 moved(width, 0);
  image.rearrange(
      image.columns + width, image.rows, [=](const Vec2& at) -> Vec2 { return at - moved; },
      [=](const Vec2& at) -> Vec2 { return at + moved; });
}

void mirror(Pixels& image) {
  const int last = image.columns - 1;
  const auto turn = [=](const Vec2& at) { return Vec2(last - at.x(), at.y()); };
  image.rearrange(image.columns, image.rows, turn, turn);
}

void turn_over(Pixels& image) {
  const int last = image.rows - 1;
  const auto turn = [=](const Vec2& at) { return Vec2(at.x(), last - at.y()); };
  image.rearrange(image.columns, image.rows, turn, turn);
}

void rotate(Pixels& image) {
  const int last = image.rows - 1;
  image.rearrange(
      image.rows, image.columns, [=](const Vec2& at) { return Vec2(at.y(), last - at.x()); },
      [=](const Vec2& at) { return Vec2(last - at.y(), at.x()); });
}

void noise(Pixels& image) {
  std::mt19937 stream(7);
  std::normal_distribution<double> normal(0, 0.002 * std::abs(image.bright - image.dark));
  const int high = std::max(image.bright, image.dark);
  for (std::uint16_t& value : image.values)
    value = std::uint16_t(std::clamp(int(value) + int(normal(stream)), 0, high));
}

std::function<void(Export&)> text(std::uint32_t tag, const char* vr, const char* value) {
  return [=](Export& e) { e.more.text(tag, vr, value); };
}
std::function<void(Export&)> drawn(void (*change)(Pixels&)) {
  return [=](Export& e) { e.pixels.emplace_back(change); };
}
std::function<void(Export&)> modifier(const char* code) {
  return [=](Export& e) { e.modifiers.push_back(code_item(code, "SCT", "modifier")); };
}
void without_view(Export& e) {
  e.more.text(0x00185101, "CS", "");
  e.view_code_instead = "000000000";
}

/// A tomosynthesis, or a cine.
void several_frames(Export& e) {
  e.more.text(0x00280008, "IS", "2");
  e.pixels.emplace_back([](Pixels& image) {
    std::vector<std::uint16_t> again = image.values;
    image.values.insert(image.values.end(), again.begin(), again.end());
  });
}

/// In the order in which they are added to an image.
const std::vector<Feature>& features() {
  static const std::vector<Feature> all = {
      {"presentation", "grey", "", "", [](Export& e) { e.for_processing = false; }},
      {"inverted", "grey", "", "inverted", text(0x00280004, "CS", "MONOCHROME2")},
      {"noise", "noise", "", "", drawn(noise)},
      {"labels", "labels", "", "", drawn(labels)},
      {"padding", "padding", "", "", drawn(padding)},
      {"frame", "frame", "", "", drawn(frame)},
      {"magnified", "scale", "", "",
       [](Export& e) { e.more.number(0x00181114, 1.8).text(0x00181164, "DS", "0.72\\0.72"); }},
      {"magnified, no factor", "scale", "does not state its factor", "", modifier("399163009")},
      {"magnified, nothing said", "scale", "times as large", "",
       text(0x00181164, "DS", "0.72\\0.72")},
      {"factor applied twice", "scale", "times as large", "",
       [](Export& e) { e.more.number(0x00181114, 1.8); }},
      {"factor 0", "scale", "", "magnification 0 is not within",
       [](Export& e) { e.more.number(0x00181114, 0); }},
      {"pixel spacing alone", "scale", "", "at the detector",
       [](Export& e) { e.more.text(0x00181164, "DS", "").text(0x00280030, "DS", "0.4\\0.4"); }},
      {"calibrated pixel spacing", "scale", "", "in the breast",
       [](Export& e) {
         e.more.text(0x00181164, "DS", "0\\0")
             .text(0x00280030, "DS", "0.4\\0.4")
             .text(0x00280a02, "CS", "GEOMETRY")
             .number(0x00181114, 1.8);
       }},
      {"no spacing", "scale", "pixel spacing is missing", "", text(0x00181164, "DS", "")},
      {"oblong pixels", "scale", "square pixels", "", text(0x00181164, "DS", "0.4\\0.5")},
      {"view in its code", "view", "", "", text(0x00185101, "CS", "")},
      {"view in a text", "view", "", "Series Description",
       [](Export& e) {
         without_view(e);
         e.more.text(0x0008103e, "LO", e.view == View::cc ? "CC" : "MLO screening");
       }},
      {"view in the device's text", "view", "", "Acquisition Device",
       [](Export& e) {
         without_view(e);
         e.more.text(0x00181400, "LO", e.view == View::cc ? "CC" : "medio-lateral oblique");
       }},
      {"no view", "view", "view position is missing", "", without_view},
      {"two views", "view", "View Code Sequence is", "", text(0x00185101, "CS", "ML")},
      {"exaggerated view", "view", "\"XCCL\"", "", text(0x00185101, "CS", "XCCL")},
      {"side in a text", "side", "", "the side",
       [](Export& e) { e.more.text(0x00200062, "CS", "").text(0x00181030, "LO", "left breast"); }},
      {"another side in its view", "side", "View Position is of the right breast", "",
       [](Export& e) { e.more.text(0x00185101, "CS", e.view == View::cc ? "RCC" : "RMLO"); }},
      {"another side in a text", "side", "", "names the right breast",
       text(0x00181030, "LO", "R routine")},
      {"no side", "side", "laterality is missing", "", text(0x00200062, "CS", "")},
      {"spot", "part", "spot compression", "", modifier("399055006")},
      {"spot paddle", "part", "spot compression", "", text(0x001811a4, "LO", "9CM SPOT")},
      {"spot paddle in one word", "part", "spot compression", "",
       text(0x001811a4, "LO", "SPOTCOMP 7.5")},
      {"spot in a text", "part", "spot compression", "",
       text(0x0008103e, "LO", "L MLO Spotkompression")},
      {"implant", "part", "implant", "", text(0x00281300, "CS", "YES")},
      {"implant displaced", "part", "implant", "", text(0x00181400, "LO", "L MLOID")},
      {"partial view", "part", "part of a breast", "", text(0x00281350, "CS", "YES")},
      {"rolled", "part", "", "rolled medially", modifier("399226006")},
      {"cleavage", "part", "", "", modifier("399161006")},
      {"thickness 0", "thickness", "", "thickness 0", text(0x001811a0, "DS", "0")},
      {"force 1100", "force", "", "force 1100", text(0x001811a2, "DS", "1100")},
      {"no number", "force", "", "not a number", text(0x001811a2, "DS", "ninety")},
      {"angle 400", "angle", "", "angle 400", text(0x00181510, "DS", "400")},
      {"angle from below", "angle", "", "",
       [](Export& e) { e.more.number(0x00181510, e.view == View::cc ? 180 : 135); }},
      {"mirrored, flip stated", "turned", "", "Horizontal Flip",
       [](Export& e) {
         e.more.text(0x00187034, "CS", "YES");
         e.pixels.emplace_back(mirror);
       }},
      {"mirrored", "turned", "", "check that it is of this breast", drawn(mirror)},
      {"upside down", "turned", "upside down", "", drawn(turn_over)},
      {"rotated by 180", "turned", "", "check that it is of this breast",
       [](Export& e) {
         e.pixels.emplace_back(mirror);
         e.pixels.emplace_back(turn_over);
       }},
      {"no orientation", "turned", "", "orientation is missing", text(0x00200020, "CS", "")},
      {"rotated by 90", "turned", "is it rotated", "", drawn(rotate)},
      {"one frame", "frames", "", "", text(0x00280008, "IS", "1")},
      {"several frames", "frames", "frames; one is expected", "", several_frames},
  };
  return all;
}

class MammogramExports : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    write_labels(*folder_ / "labels.vtkhdf", fixtures::analytic_labels());
    for (const View view : {View::cc, View::mlo}) {
      const std::string name = view_column(view);
      meshes_[view] = lopsided(fixtures::landmarked_breast(8), view);
      write_mesh(*folder_ / (name + ".vtkhdf"), meshes_[view]);
      const ToolResult result =
          run_tool("project-mammogram",
                   {name + ".vtkhdf", name + ".vti", "--pixel", "0.4", "--energy", "W/Rh:28"},
                   folder_->path());
      ASSERT_EQ(result.exit_code, 0) << result.err;
      images_[view] = fixtures::moved(read_mammogram(*folder_ / (name + ".vti")), known, pixel_mm,
                                      columns, rows);
    }
    const Matcher matcher(meshes_[View::cc], meshes_[View::mlo]);
    simulated_.emplace(View::cc, SimulatedView(matcher, MatchEnd::from));
    simulated_.emplace(View::mlo, SimulatedView(matcher, MatchEnd::to));
  }
  static void TearDownTestSuite() { delete folder_; }

  /// A compressed breast that reaches farther forward on one side, so that its outline shows which way is
  /// up.
  static HexMesh lopsided(HexMesh mesh, View view) {
    mesh.reference = mesh.imaged;
    const HexMesh plain = fixtures::squashed(mesh, view, 0.6);
    const ViewPose pose = view_pose(mesh.side, view_angle_deg(view));
    std::size_t node = 0;
    return fixtures::deformed(mesh, view, [&](const Vec3&) -> Vec3 {
      const Vec3 at = plain.points[node++];
      const double beyond = std::max(0.0, at.dot(pose.e_v));
      return at + 0.005 * beyond * beyond * pose.e_u;
    });
  }

  static fs::path written(const Export& made, Pixels& pixels) {
    const fs::path file = *folder_ / "image.dcm";
    const Mammogram& image = images_.at(made.view);
    write_mammogram_dicom(file, image, {made.for_processing, 50, 90, {}});
    std::string bytes = read_text(file);
    const std::size_t size = 2 * image.path.size();
    pixels.columns = image.width;
    pixels.rows = image.height;
    pixels.values.resize(image.path.size());
    pixels.bright = made.for_processing ? 0 : 65535;
    pixels.dark = made.for_processing ? 16383 : 0;
    std::memcpy(pixels.values.data(), bytes.data() + bytes.size() - size, size);
    for (const auto& change : made.pixels) change(pixels);
    bytes.resize(bytes.size() - size - 12);  // the pixel data with their head
    if (!made.view_code_instead.empty()) {
      for (const char* code : {"399162004", "399368009"}) {
        const auto at = bytes.find(code);
        if (at != std::string::npos) bytes.replace(at, 9, made.view_code_instead);
      }
    }
    DatasetBuilder more = made.more;
    more.sequence(0x00540222, made.modifiers);
    more.unsigned_short(0x00280010, std::uint16_t(pixels.rows))
        .unsigned_short(0x00280011, std::uint16_t(pixels.columns))
        .words(0x7fe00010,
               {reinterpret_cast<const char*>(pixels.values.data()), 2 * pixels.values.size()});
    write_text(file, bytes + more.bytes());
    return file;
  }

  /// "registered", having checked it, or the refusal.
  static std::string outcome(const Export& made, const std::vector<const Feature*>& with) {
    Pixels pixels;
    const fs::path file = written(made, pixels);
    try {
      const AlignedView view(read_mammogram_dicom(file), simulated_.at(made.view), {}, "image");
      EXPECT_LT(view.alignment().residual_mm, 0.4);
      double farthest = 0;
      for (const Vec2& uv : view.simulated_outline()) {
        const Vec2 expected = pixels.place(known.apply(uv) / pixel_mm);
        farthest = std::max(farthest, pixel_mm * (view.pixel(uv) - expected).norm());
      }
      EXPECT_LT(farthest, 1.5);
      std::vector<std::string> said = view.remarks();
      for (const std::string& doubt : view.doubts()) said.push_back(doubt);
      for (const Feature* feature : with) {
        EXPECT_TRUE(std::any_of(
            said.begin(), said.end(),
            [&](const std::string& text) { return text.find(feature->said) != std::string::npos; }))
            << feature->said << ": not said";
      }
      return "registered";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return error.what();
    }
  }

  /// Adds them in their order, and compares the outcome with what is expected of them together.
  static void check(View view, const std::vector<const Feature*>& with) {
    Export made;
    made.view = view;
    std::string name = view_name(view);
    for (const Feature* feature : with) {
      feature->add(made);
      name += std::string(", ") + feature->name;
    }
    SCOPED_TRACE(name);
    const std::string says = outcome(made, with);
    const bool refused =
        std::any_of(with.begin(), with.end(), [](const Feature* f) { return *f->refusal != '\0'; });
    const bool named = std::any_of(with.begin(), with.end(), [&](const Feature* f) {
      return *f->refusal != '\0' && says.find(f->refusal) != std::string::npos;
    });
    EXPECT_TRUE(refused ? named : says == "registered") << says;
    ++counts_[refused ? "refused by name" : "registered"];
  }

  static inline ScratchFolder* folder_ = nullptr;
  static inline std::map<View, HexMesh> meshes_;
  static inline std::map<View, Mammogram> images_;
  static inline std::map<View, SimulatedView> simulated_;
  static inline std::map<std::string, int> counts_;
};

TEST_F(MammogramExports, EachIsRegisteredWhereItIsOrRefusedByName) {
  for (const View view : {View::cc, View::mlo}) {
    check(view, {});
    for (const Feature& feature : features()) check(view, {&feature});
  }
}

TEST_F(MammogramExports, SoIsEveryTwo) {
  for (auto a = features().begin(); a != features().end(); ++a) {
    for (auto b = std::next(a); b != features().end(); ++b) {
      if (a->kind != std::string(b->kind)) check(View::mlo, {&*a, &*b});
    }
  }
  for (const auto& [what, times] : counts_) std::printf("%4d  %s\n", times, what.c_str());
}

}  // namespace
}  // namespace breast
