// SPDX-License-Identifier: GPL-3.0-or-later
#include "page/page.hpp"

#include "core/error.hpp"
#include "page/parts.hpp"
#include "page/script_text.hpp"

namespace breast {

extern const char* const page_html;

namespace {

void check_view(const Mammogram& image, View view, Side side) {
  if (image.view == view && image.side == side) return;
  throw input_error("the image shows ", view_name(image.view), " of the ", side_name(image.side),
                    " breast, but the compression ", view_name(view), " of the ", side_name(side));
}

void check(const PageContents& contents) {
  const MatchLookup &there = contents.there, &back = contents.back;
  check_view(contents.from, there.from_view, there.side);
  check_view(contents.to, there.to_view, there.side);
  if (back.from_view == there.to_view && back.to_view == there.from_view && back.side == there.side)
    return;
  throw input_error("the lookup back goes from ", view_name(back.from_view), " to ",
                    view_name(back.to_view), ", but the first lookup from ",
                    view_name(there.from_view), " to ", view_name(there.to_view));
}

std::string data_json(const PageContents& contents) {
  const HexMesh& body = contents.matcher.from();
  const Vec3 middle = imaged_box(body).middle();
  std::string without;
  for (const std::string& name : contents.there.band_without)
    without += (without.empty() ? "" : ", ") + name;
  return "{\"side\":" + script_text(std::string(side_name(contents.there.side))) +
         ",\"band_without\":" + script_text(without) + ",\"images\":[" +
         image_json(contents.from, body) + "," + image_json(contents.to, contents.matcher.to()) +
         "],\"lookups\":[" + lookup_json(contents.there, middle) + "," +
         lookup_json(contents.back, middle) + "],\"body\":" + body_json(body) +
         ",\"scan\":" + (contents.scan != nullptr ? scan_json(*contents.scan, body) : "null") + "}";
}

}  // namespace

std::string lookup_page(const PageContents& contents) {
  check(contents);
  std::string page = page_html;
  const std::string mark = "\"DATA\"";
  page.replace(page.find(mark), mark.size(), data_json(contents));
  if (page.size() > largest_page) {
    throw input_error("the page would have ", page.size() / 1000000, " MB, at most ",
                      largest_page / 1000000, " allowed; use a larger --pitch or omit --scan");
  }
  return page;
}

}  // namespace breast
