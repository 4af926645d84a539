// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/mammogram_view.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

#include "core/text/lists.hpp"
#include "core/text/trimmed.hpp"

namespace breast {

namespace {

struct Place {
  const char *key, *name;
};
constexpr std::array<Place, 3> texts{{{"0018|1400", "Acquisition Device Processing Description"},
                                      {"0008|103e", "Series Description"},
                                      {"0018|1030", "Protocol Name"}}};
constexpr const char* paddle_description = "0018|11a4";

/// Views by their codes in SNOMED CT and SNOMED RT (PS3.16 CID 4014).
struct CodedView {
  const char *ct, *rt, *name;
  std::optional<View> view;  ///< none: not simulated
};
constexpr std::array<CodedView, 11> coded_views{
    {{"399162004", "R-10242", "cranio-caudal", View::cc},
     {"399368009", "R-10226", "medio-lateral oblique", View::mlo},
     {"399260004", "R-10224", "medio-lateral", View::ml},
     {"399352003", "R-10228", "latero-medial", {}},
     {"399099002", "R-10230", "latero-medial oblique", {}},
     {"399196006", "R-10244", "caudo-cranial", {}},
     {"399188001", "R-102D0", "superolateral to inferomedial oblique", {}},
     {"441555000", "R-40AAA", "inferomedial to superolateral oblique", {}},
     {"399192008", "R-1024A", "cranio-caudal exaggerated laterally", {}},
     {"399101009", "R-1024B", "cranio-caudal exaggerated medially", {}},
     {"127457009", "G-8310", "tissue specimen from breast", {}}}};

/// The view's modifiers likewise (CID 4015).
enum class Effect { none, remark, magnified, spot, implant };
struct Modifier {
  const char *ct, *rt, *name;
  Effect effect;
};
constexpr std::array<Modifier, 14> known_modifiers{
    {{"399161006", "R-102D2", "cleavage", Effect::none},
     {"399011000", "R-102D1", "axillary tail", Effect::remark},
     {"399197002", "R-102D3", "rolled laterally", Effect::remark},
     {"399226006", "R-102D4", "rolled medially", Effect::remark},
     {"414493004", "R-102CA", "rolled inferiorly", Effect::remark},
     {"415670009", "R-102C9", "rolled superiorly", Effect::remark},
     {"399209000", "R-102D5", "implant displaced", Effect::implant},
     {"399163009", "R-102D6", "magnification", Effect::magnified},
     {"399055006", "R-102D7", "spot compression", Effect::spot},
     {"399110001", "R-102C2", "tangential", Effect::remark},
     {"442581004", "R-40AB3", "nipple in profile", Effect::none},
     {"441752004", "P2-00161", "anterior compression", Effect::remark},
     {"442593008", "R-40ABE", "infra-mammary fold", Effect::none},
     {"442580003", "R-40AB2", "axillary tissue", Effect::none}}};

/// The values of a code, which several items may give.
std::vector<std::string> codes_at(const MammogramFields& fields, const char* key) {
  std::vector<std::string> codes;
  for (const std::string& code : split(fields.text(key), '\\')) {
    if (!trimmed(code).empty()) codes.push_back(trimmed(code));
  }
  return codes;
}

template <class Coded, std::size_t N>
const Coded* find_code(const std::array<Coded, N>& known, const std::string& code) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const Coded& one) {
    return code == one.ct || code == one.rt;
  });
  return found == known.end() ? nullptr : &*found;
}

/// Its modifiers; null for one that is unknown. Some programs write them beside the view instead of within
/// it.
std::vector<const Modifier*> modifiers_of(const MammogramFields& fields) {
  std::vector<const Modifier*> all;
  for (const char* key : {"0054|0220/0054|0222/0008|0100", "0054|0222/0008|0100"}) {
    for (const std::string& code : codes_at(fields, key))
      all.push_back(find_code(known_modifiers, code));
  }
  return all;
}

bool has(const MammogramFields& fields, Effect effect) {
  const auto all = modifiers_of(fields);
  return std::any_of(all.begin(), all.end(),
                     [&](const Modifier* one) { return one != nullptr && one->effect == effect; });
}

/// Words of letters and digits, in capitals.
std::vector<std::string> capital_words(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isalnum(code) != 0) {
      words.back() += char(std::toupper(code));
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// "RMLO" is R and MLO, and a view displaced from an implant ends with ID.
struct ViewWord {
  std::optional<Side> side;
  std::optional<View> view;
  bool implant = false;
};
ViewWord view_word(std::string word) {
  ViewWord read;
  if (word == "ID") return {{}, {}, true};
  if (word == "L" || word == "LEFT") return {Side::left, {}};
  if (word == "R" || word == "RIGHT") return {Side::right, {}};
  if (word.size() > 3 && word.ends_with("ID") && view_word(word.substr(0, word.size() - 2)).view) {
    word.resize(word.size() - 2);
    read.implant = true;
  }
  read.view = view_from_name(word);
  if (!read.view && !word.empty() && (word[0] == 'L' || word[0] == 'R')) {
    read.view = view_from_name(std::string_view(word).substr(1));
    if (read.view) read.side = word[0] == 'L' ? Side::left : Side::right;
  }
  return read;
}

/// A view that is written out.
std::optional<View> spelled_view(const std::vector<std::string>& words) {
  const std::string all = join(words, "");
  const auto says = [&](const char* name) { return all.find(name) != std::string::npos; };
  if (says("EXAGGERATED")) return std::nullopt;
  if (says("MEDIOLATERALOBLIQUE")) return View::mlo;
  if (says("MEDIOLATERAL")) return View::ml;
  if (says("CRANIOCAUDAL")) return View::cc;
  return std::nullopt;
}

template <class T>
std::optional<T> the_only(const std::set<T>& all) {
  return all.size() == 1 ? std::optional(*all.begin()) : std::nullopt;
}

/// The words of the texts that describe the image, its view and the paddle.
std::vector<std::string> described_by(const MammogramFields& fields) {
  std::vector<std::string> words = capital_words(fields.text("0018|5101"));
  const auto add = [&](const char* key) {
    for (std::string& word : capital_words(fields.text(key))) words.push_back(std::move(word));
  };
  for (const Place& place : texts) add(place.key);
  add(paddle_description);
  return words;
}

/// Whether one of them begins so: "SPOTCOMP" and "Spotkompression" are spot compressions.
bool is_described(const MammogramFields& fields, std::string_view start) {
  const std::vector<std::string> words = described_by(fields);
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return word.starts_with(start); });
}

bool is_named(const MammogramFields& fields, std::string_view wanted) {
  const std::vector<std::string> words = described_by(fields);
  return std::find(words.begin(), words.end(), wanted) != words.end();
}

bool is_described_as_implant(const MammogramFields& fields) {
  const std::vector<std::string> words = described_by(fields);
  return std::any_of(words.begin(), words.end(),
                     [](const std::string& word) { return view_word(word).implant; });
}

/// The view of View Code Sequence, if it is stated.
std::optional<View> coded_view(const MammogramFields& fields) {
  std::set<View> views;
  for (const std::string& code : codes_at(fields, "0054|0220/0008|0100")) {
    const CodedView* known = find_code(coded_views, code);
    if (known == nullptr) continue;
    if (!known->view) throw fields.missing("view code", known->name, "CC, MLO or ML");
    views.insert(*known->view);
  }
  return the_only(views);
}

/// What the first text with an answer says.
template <class Answer>
auto from_texts(MammogramFields& fields, const char* what, const Answer& answer)
    -> decltype(answer("")) {
  for (const Place& place : texts) {
    const auto found = answer(fields.text(place.key));
    if (!found) continue;
    fields.remark(message(what, " is taken from the text of ", place.name));
    return found;
  }
  return {};
}

}  // namespace

std::optional<View> view_in_text(const std::string& text) {
  const std::vector<std::string> words = capital_words(text);
  std::set<View> views;
  for (const std::string& word : words) {
    if (const auto view = view_word(word).view) views.insert(*view);
  }
  return views.empty() ? spelled_view(words) : the_only(views);
}

std::optional<Side> side_in_text(const std::string& text) {
  std::set<Side> sides;
  for (const std::string& word : capital_words(text)) {
    if (const auto side = view_word(word).side) sides.insert(*side);
  }
  return the_only(sides);
}

View stated_view(MammogramFields& fields) {
  const std::string position = fields.text("0018|5101");
  const std::optional<View> positioned = view_in_text(position), coded = coded_view(fields);
  if (!positioned && !position.empty())
    throw fields.missing("view position", position, "CC, MLO or ML");
  if (positioned && coded && *positioned != *coded) {
    throw input_error(fields.where(), ": View Position is ", view_name(*positioned),
                      ", but View Code Sequence is ", view_name(*coded),
                      "; correct the one that is wrong");
  }
  if (positioned) return *positioned;
  if (coded) return *coded;
  const std::optional<View> described = from_texts(fields, "the view", view_in_text);
  if (!described) throw fields.missing("view position", "", "CC, MLO or ML");
  return *described;
}

namespace {

/// "RCC" as the view of a left breast is a contradiction; a text of the series may be that of another image.
void check_side(MammogramFields& fields, Side side) {
  const std::optional<Side> positioned = side_in_text(fields.text("0018|5101"));
  if (positioned && *positioned != side) {
    throw input_error(fields.where(), ": View Position is of the ", side_name(*positioned),
                      " breast, but the laterality is that of the ", side_name(side),
                      "; correct the one that is wrong");
  }
  for (const Place& place : texts) {
    const std::optional<Side> described = side_in_text(fields.text(place.key));
    if (!described || *described == side) continue;
    fields.remark(message("the text of ", place.name, " names the ", side_name(*described),
                          " breast, but the laterality is that of the ", side_name(side),
                          ", which is taken"));
  }
}

}  // namespace

Side stated_side(MammogramFields& fields) {
  std::string side = fields.text("0020|0062");
  if (side.empty()) side = fields.text("0020|0060");
  if (side == "L" || side == "R") {
    const Side stated = side == "L" ? Side::left : Side::right;
    check_side(fields, stated);
    return stated;
  }
  const std::optional<Side> described =
      side.empty() ? from_texts(fields, "the side", side_in_text) : std::nullopt;
  if (!described) throw fields.missing("image laterality", side, "L or R");
  return *described;
}

void refuse_what_is_not_simulated(MammogramFields& fields) {
  if (has(fields, Effect::spot) || is_described(fields, "SPOT")) {
    throw input_error(fields.where(),
                      ": a spot compression, which presses a part of the breast: the simulated "
                      "plates press all of it; give the whole view");
  }
  if (fields.text("0028|1300") == "YES" || has(fields, Effect::implant) ||
      is_described(fields, "IMPLANT") || is_described_as_implant(fields)) {
    throw input_error(fields.where(),
                      ": shows a breast with an implant, which the model does not have");
  }
  if (fields.text("0028|1350") == "YES") {
    throw input_error(fields.where(),
                      ": shows a part of a breast (Partial View), whose outline does not determine "
                      "its place; give a view of the whole breast");
  }
  for (const Modifier* one : modifiers_of(fields)) {
    if (one == nullptr) {
      fields.remark("its view has a modifier that is unknown (not in CID 4015)");
    } else if (one->effect == Effect::remark) {
      fields.remark(message("its view has the modifier \"", one->name,
                            "\", which the simulated compression does not have"));
    }
  }
}

bool is_magnification_view(const MammogramFields& fields) {
  return has(fields, Effect::magnified) || is_described(fields, "MAGNIF") ||
         is_named(fields, "MAG");
}

}  // namespace breast
