// SPDX-License-Identifier: GPL-3.0-or-later
// Mammograms with curves on them: Fig. 6.
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "core/table.hpp"
#include "figures/parts.hpp"
#include "projection/display.hpp"

namespace breast {

namespace {

constexpr double above_image = 1;  // mm

// Converts an image position (u,v) in mm to the plane of the picture as it is hung, y up.
class Hanging {
 public:
  explicit Hanging(const Mammogram& image)
      : left_(image.side == Side::left),
        width_(image.pixel * (image.width - 1)),
        height_(image.pixel * (image.height - 1)) {}
  Vec3 at(const Vec2& uv, double z = above_image) const {
    return left_ ? Vec3(uv.x(), height_ - uv.y(), z) : Vec3(width_ - uv.x(), uv.y(), z);
  }
  bool left() const { return left_; }
  double width() const { return width_; }
  double height() const { return height_; }

 private:
  bool left_;
  double width_, height_;
};

struct ImageLine {
  int query = 0;
  std::vector<Vec2> uv;
};

/// The lines whose names satisfy `wanted`.
std::vector<ImageLine> image_lines(const PolyLines& lines,
                                   const std::function<bool(const std::string&)>& wanted) {
  std::vector<ImageLine> found;
  const auto data = [&](const char* name) -> const std::vector<double>& {
    const auto at = lines.point_data.find(name);
    if (at != lines.point_data.end()) return at->second;
    throw input_error("the file of curves has no PointData ", name, "; make it with cc2mlo");
  };
  const auto &u = data("u_mm"), &v = data("v_mm"), &query = data("query");
  for (std::size_t i = 0; i < lines.lines.size() && i < lines.line_names.size(); ++i) {
    if (!wanted(lines.line_names[i]) || lines.lines[i].empty()) continue;
    found.push_back({int(query[lines.lines[i].front()]), {}});
    for (const int p : lines.lines[i]) found.back().uv.emplace_back(u[p], v[p]);
  }
  return found;
}

std::vector<ImageLine> image_lines(const PolyLines& lines, const std::string& name) {
  return image_lines(lines, [&](const std::string& line) { return line == name; });
}

/// The position given for the MLO view: the truth, a mark, or the model's own landmark. (Files of
/// before 0.2 call the model's own place "truth in MLO" too.)
bool is_place(const std::string& line) {
  return line.ends_with(" in MLO") &&
         (line.starts_with("truth") || line.starts_with("mark") || line.starts_with("model's"));
}

bool of_artificial_tumour(const PolyLines& lines) {
  return std::any_of(lines.line_names.begin(), lines.line_names.end(),
                     [](const auto& name) { return name.starts_with("model's artificial"); });
}

Colour query_colour(int query, int count) {
  if (count <= 1) return palette::tumour;
  const double hue = 6.0 * query / count;  // round the colour circle
  const auto channel = [&](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return std::clamp(std::min(k, 4 - k), 0.0, 1.0);
  };
  return {1 - 0.9 * channel(5), 1 - 0.9 * channel(3), 1 - 0.9 * channel(1)};
}

constexpr double nipple_pixels = 9, point_pixels = 6;

/// A ring to draw when the camera stands.
struct Mark {
  Vec3 at;
  double radius;
  Colour colour;
};

std::string add_curves(Panel& panel, const Mammogram& image, const PolyLines& curves,
                       const Hanging& hanging, std::vector<Mark>& marks) {
  const auto points = image_lines(curves, "point in CC");
  const int count = int(points.size());
  const Vec2 size(hanging.width(), hanging.height());
  double outside = 0;
  // The parts outside the image are not drawn, but reported. Returns their length.
  const auto draw = [&](const ImageLine& line, const Colour& colour, double width) {
    double lost = 0;
    for (const auto& part : parts_inside(line.uv, size, &lost)) {
      std::vector<Vec3> path;
      for (const Vec2& uv : part) path.push_back(hanging.at(uv));
      panel.stroke(path, colour, width);
    }
    return lost;
  };
  const bool cc = image.view == View::cc;
  for (const auto& nipple : image_lines(curves, cc ? "nipple in CC" : "nipple in MLO")) {
    marks.push_back({hanging.at(nipple.uv[0]), nipple_pixels, white});
  }
  if (cc) {
    for (const auto& p : points) {
      marks.push_back({hanging.at(p.uv[0]), count > 1 ? point_pixels : point_ring_pixels,
                       query_colour(p.query, count)});
    }
    if (count > 1) return "points";
    return of_artificial_tumour(curves) ? "yellow ring: artificial tumour; white: nipple"
                                        : "yellow ring: the point; white: nipple";
  }
  if (count == 1) {
    for (const auto& line : image_lines(curves, "arc")) draw(line, palette::arc, 2.5);
  }
  for (const auto& line : image_lines(curves, "curve")) {
    outside += draw(line, count == 1 ? Colour{0.1, 0.9, 0.4} : query_colour(line.query, count), 3);
  }
  const auto places = image_lines(curves, is_place);
  for (const auto& p : places) {
    marks.push_back(
        {hanging.at(p.uv[0]), count > 1 ? point_pixels : point_ring_pixels, palette::tumour});
  }
  const std::string lost =
      outside >= 0.5 ? " (" + format_fixed(outside, 0) + " mm outside the image)" : "";
  if (count > 1) return "their curves" + lost;
  const std::string words = "green: its curve" + lost + "; blue: equal nipple distance";
  if (places.empty()) return words;
  if (of_artificial_tumour(curves)) return words + "; ring: artificial tumour";
  return words + "; ring: model's own place";
}

void axis_ticks(Panel& panel, const Mammogram& image, const Hanging& hanging) {
  constexpr double step = 20, letters = 14;
  const Vec2 low = panel.to_pixel({0, 0, 0}),
             high = panel.to_pixel({hanging.width(), hanging.height(), 0});
  // Muscle at the edge may be as white as the paper.
  for (const auto& [a, b] :
       {std::pair(low, Vec2(low.x(), high.y())), std::pair(Vec2(high.x(), low.y()), high)})
    panel.line(a, b, palette::ink, 1);
  for (double u = 0; u <= hanging.width(); u += step) {
    const Vec2 at(panel.to_pixel(hanging.at({u, 0}, 0)).x(), low.y());
    panel.line(at, at - Vec2(0, 6), palette::ink, 1);
    panel.text(at - Vec2(0, 16), format_fixed(u, 0), letters, palette::ink, Align::centre);
  }
  // v on the anterior side: the chest wall is at the picture's outer edge.
  const double x = hanging.left() ? high.x() : low.x();
  const double outward = hanging.left() ? 1 : -1;
  const Align align = hanging.left() ? Align::left : Align::right;
  for (double v = 0; v <= hanging.height(); v += step) {
    const Vec2 at(x, panel.to_pixel(hanging.at({0, v}, 0)).y());
    panel.line(at, at + Vec2(6 * outward, 0), palette::ink, 1);
    panel.text(at + Vec2(10 * outward, 0), format_fixed(v, 0), letters, palette::ink, align);
  }
  const std::string anterior = "u (mm) from the posterior edge";
  panel.text({0.5 * (low.x() + high.x()), low.y() - 36}, anterior, letters, palette::ink,
             Align::centre);
  panel.text({x + 10 * outward, low.y() - 18}, "v (mm)", letters, palette::ink, align);
  const Vec2 edge(panel.to_pixel(hanging.at({image.plate_edge_u, 0}, 0)).x(), low.y());
  // Where the image begins at the plates, they need no mark.
  if (image.plate_edge_u > 1) {
    for (double y = low.y(); y < high.y(); y += 9) {
      panel.line({edge.x(), y}, {edge.x(), std::min(y + 3, high.y())}, {0.7, 0.7, 0.7}, 1);
    }
    panel.text(Vec2(edge.x() + 6 * outward, low.y() + 34), "plates from here", letters - 2,
               {0.85, 0.85, 0.85}, align);
  }
  const auto& back = image.through_back;
  if (const auto first =
          std::find_if(back.begin(), back.end(), [](auto flag) { return flag != 0; });
      first != back.end()) {
    const bool blank = image.blank(std::size_t(first - back.begin()));
    const double chest = hanging.left() ? low.x() + 6 : high.x() - 6;
    panel.text({chest, low.y() + 14}, blank ? "even grey: unknown" : "behind the model: fat",
               letters - 2, {0.85, 0.85, 0.85}, hanging.left() ? Align::left : Align::right);
  }
  const std::string top = image.view == View::cc ? "lateral" : "superior";
  const std::string bottom = image.view == View::cc ? "medial" : "inferior";
  const double inset = hanging.left() ? high.x() - 10 : low.x() + 10;
  const Align inner = hanging.left() ? Align::right : Align::left;
  const std::string marker = (hanging.left() ? "L " : "R ") + view_name(image.view);
  panel.text({inset, high.y() - 18}, marker, 22, white, inner);
  panel.text({inset, high.y() - 42}, top, letters, white, inner);
  // In a narrow image above the words at the chest wall.
  const double row = high.x() - low.x() < 400 ? 54 : 14;
  panel.text({inset, low.y() + row}, bottom, letters, white, inner);
}

}  // namespace

std::vector<std::vector<Vec2>> parts_inside(const std::vector<Vec2>& line, const Vec2& size,
                                            double* outside_mm) {
  std::vector<std::vector<Vec2>> parts;
  double all = 0, kept = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec2 &a = line[i], along = line[i + 1] - a;
    all += along.norm();
    // The segment from t = low to high lies within all four sides.
    double low = 0, high = 1;
    for (int d = 0; d < 2; ++d) {
      for (const double side : {0.0, size[d]}) {
        const double room = side > 0 ? side - a[d] : a[d];       // >= 0: a is within this side
        const double closing = side > 0 ? along[d] : -along[d];  // by which the way to b lessens it
        if (closing > 0) high = std::min(high, room / closing);
        if (closing < 0) low = std::max(low, room / closing);
        if (closing == 0 && room < 0) high = -1;
      }
    }
    if (!(high > low)) continue;
    kept += (high - low) * along.norm();
    const Vec2 start = a + low * along, end = a + high * along;
    if (parts.empty() || low > 0 || (parts.back().back() - start).norm() > 1e-9)
      parts.push_back({start});
    parts.back().push_back(end);
  }
  if (outside_mm != nullptr) *outside_mm = all - kept;
  return parts;
}

void add_mammogram(Panel& panel, const Mammogram& image, const PolyLines* curves,
                   const std::string& letter) {
  const HungImage hung = hang(image);
  const Hanging hanging(image);
  panel.image(hung.grey, hung.width, hung.height, image.pixel);
  std::string words = letter + view_name(image.view);
  std::vector<Mark> marks;
  if (curves != nullptr) words += "; " + add_curves(panel, image, *curves, hanging, marks);
  // Room for axes (70 and 100 pixels beside and below) and caption.
  const int more_lines = panel.caption(words) - 1;
  const Vec2 free = panel.size() - Vec2(100, 110 + 22 * more_lines);
  const double scale = std::max(hanging.width() / free.x(), hanging.height() / free.y());
  const double sideways = hanging.left() ? 12 : -12;
  panel.look_along({0, 0, -1}, {0, 1, 0},
                   Vec3(hanging.width() / 2, hanging.height() / 2, 0) +
                       scale * Vec3(sideways, -10 + 11 * more_lines, 0),
                   scale * panel.size().y());
  for (const Mark& mark : marks) panel.ring(mark.at, mark.radius, mark.colour);
  axis_ticks(panel, image, hanging);
}

void draw_mammogram(Picture& picture, const FigureInput& input) {
  need(!input.images.empty(), "mammogram", "a mammogram .vti");
  const std::size_t count = std::min<std::size_t>(2, input.images.size());
  const PolyLines* curves = input.curves ? &*input.curves : nullptr;
  for (std::size_t k = 0; k < count; ++k) {
    Panel& panel = picture.panel(double(k) / double(count), 0, double(k + 1) / double(count), 1);
    add_mammogram(panel, input.images[k], curves, k == 0 ? "(a) " : "(b) ");
  }
}

}  // namespace breast
