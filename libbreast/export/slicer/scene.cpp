// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/slicer/scene.hpp"

#include <map>

#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

// The element names of a node, its display and its storage, and the prefixes of their ids.
struct Tags {
  const char *node, *node_class, *display, *display_class, *storage, *storage_class;
};

Tags tags_of(SceneKind kind) {
  switch (kind) {
    case SceneKind::volume:
      return {"Volume",
              "ScalarVolumeNode",
              "VolumeDisplay",
              "ScalarVolumeDisplayNode",
              "VolumeArchetypeStorage",
              "VolumeArchetypeStorageNode"};
    case SceneKind::segmentation:
      return {"Segmentation",        "SegmentationNode",
              "SegmentationDisplay", "SegmentationDisplayNode",
              "SegmentationStorage", "SegmentationStorageNode"};
    case SceneKind::model:
      return {"Model",        "ModelNode",       "ModelDisplay", "ModelDisplayNode",
              "ModelStorage", "ModelStorageNode"};
    case SceneKind::transform:
      return {"GridTransform",        "GridTransformNode", "TransformDisplay",
              "TransformDisplayNode", "TransformStorage",  "TransformStorageNode"};
    case SceneKind::points:
      return {"MarkupsFiducial",        "MarkupsFiducialNode",
              "MarkupsFiducialDisplay", "MarkupsFiducialDisplayNode",
              "MarkupsJsonStorage",     "MarkupsJsonStorageNode"};
    case SceneKind::curve:
      return {"MarkupsCurve",       "MarkupsCurveNode",   "MarkupsDisplay",
              "MarkupsDisplayNode", "MarkupsJsonStorage", "MarkupsJsonStorageNode"};
  }
  throw failed_error("scene: no such kind of node");
}

class SceneWriter {
 public:
  void add(const SceneItem& item) {
    const Tags tags = tags_of(item.kind);
    const std::string storage = id(tags.storage_class), display = id(tags.display_class),
                      node = id(tags.node_class);
    text_ += " <" + std::string(tags.storage) + " id=\"" + storage + "\" name=\"" +
             escaped(item.name) + " storage\" fileName=\"" + escaped(item.file) +
             "\" useCompression=\"1\"" + storage_attributes(item.kind) + "/>\n";
    text_ += " <" + std::string(tags.display) + " id=\"" + display + "\" name=\"" +
             escaped(item.name) + " display\"" + display_attributes(item) + "/>\n";
    text_ += " <" + std::string(tags.node) + " id=\"" + node + "\" name=\"" + escaped(item.name) +
             "\" description=\"" + escaped(item.description) +
             "\" hideFromEditors=\"false\" selectable=\"true\" selected=\"false\"" +
             (item.kind == SceneKind::volume ? " labelMap=\"0\"" : "") +
             (item.kind == SceneKind::transform ? " readAsTransformToParent=\"0\"" : "") +
             " references=\"display:" + display + ";storage:" + storage + ";\"/>\n";
    if (item.kind == SceneKind::volume) volumes_.push_back(node);
  }

  void add_slices() {
    for (const char* view : {"Red", "Yellow", "Green"}) {
      text_ += message(" <SliceComposite id=\"vtkMRMLSliceCompositeNode", view, "\" name=\"", view,
                       " composite\" singletonTag=\"", view, "\" layoutName=\"", view, "\"");
      if (!volumes_.empty()) text_ += " backgroundVolumeID=\"" + volumes_[0] + "\"";
      if (volumes_.size() > 1) text_ += " foregroundVolumeID=\"" + volumes_[1] + "\"";
      text_ += " foregroundOpacity=\"0\" labelOpacity=\"1\" linkedControl=\"1\"/>\n";
    }
  }

  const std::string& text() const { return text_; }

 private:
  std::string id(const std::string& node_class) {
    return "vtkMRML" + node_class + std::to_string(++count_[node_class]);
  }

  static std::string storage_attributes(SceneKind kind) {
    const bool places =
        kind == SceneKind::model || kind == SceneKind::points || kind == SceneKind::curve;
    return places ? " coordinateSystem=\"LPS\"" : "";
  }

  static std::string display_attributes(const SceneItem& item) {
    const std::string seen = item.visible ? "true" : "false";
    std::string colour;
    for (const double part : item.colour)
      colour += (colour.empty() ? "" : " ") + format_fixed(part, 4);
    const std::string opacity = format_number(item.opacity);
    switch (item.kind) {
      case SceneKind::volume:
        return " autoWindowLevel=\"1\" interpolate=\"1\" references=\"color:vtkMRMLColorTableNodeGrey;\"";
      case SceneKind::segmentation:
        return " visibility=\"" + seen + "\" opacity=\"" + opacity +
               "\" Visibility2DFill=\"true\" Visibility2DOutline=\"true\" Visibility3D=\"false\" "
               "Opacity2DFill=\"0.3\" Opacity2DOutline=\"1\"";
      case SceneKind::model:
        return " color=\"" + colour + "\" opacity=\"" + opacity + "\" visibility=\"" + seen +
               "\" visibility2D=\"" + seen + "\" sliceIntersectionVisibility=\"" + seen +
               "\" sliceIntersectionThickness=\"2\" scalarVisibility=\"false\" "
               "backfaceCulling=\"false\"";
      case SceneKind::transform:
        return " visibility=\"false\"";
      case SceneKind::points:
      case SceneKind::curve:
        return " color=\"" + colour + "\" selectedColor=\"" + colour + "\" opacity=\"" + opacity +
               "\" visibility=\"" + seen + "\" pointLabelsVisibility=\"" +
               (item.kind == SceneKind::points ? "true" : "false") +
               "\" textScale=\"3\" glyphScale=\"2\" sliceProjection=\"true\"";
    }
    return "";
  }

  std::string text_;
  std::map<std::string, int> count_;
  std::vector<std::string> volumes_;
};

}  // namespace

std::string scene_xml(const std::vector<SceneItem>& items) {
  SceneWriter writer;
  for (const SceneItem& item : items) writer.add(item);
  writer.add_slices();
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- written by " + std::string(maker_mark) +
         ": places are LPS, mm -->\n<MRML version=\"Slicer 5.2.2\" userTags=\"\">\n" +
         writer.text() + "</MRML>\n";
}

}  // namespace breast
